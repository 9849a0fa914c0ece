// SPDX-License-Identifier: Apache-2.0
// lightcal for pipelines. Every function takes the command's own words and gives the document that
// the command prints with --json.
import { runCommand } from './wasi.js';
import { MemoryFiles } from './memory_files.js';
import { lightcalModule, nodeCommand } from './node_command.js';

export class LightcalError extends Error {
  constructor(exitCode, { code, subject, message }) {
    super(subject ? `${subject}: ${message}` : message);
    this.name = 'LightcalError';
    Object.assign(this, { exitCode, code, subject });
  }
}

// One command line as it stands: { code, out, err }. With `files` ({ "/lamp/session.toml": text })
// it sees these alone, and `files` in the answer holds them all afterwards.
export function command(words, { files } = {}) {
  if (files) {
    const memory = new MemoryFiles(files);
    const answer = runCommand(lightcalModule(), words, { files: memory });
    return { ...answer, files: Object.fromEntries(memory.contents) };
  }
  return nodeCommand(words);
}

function documentOf(words, options) {
  const answer = command([...words, '--json'], options);
  let found;
  try {
    found = JSON.parse(answer.out);
  } catch {
    throw new LightcalError(answer.code, { code: 'internal', message: answer.err.trim() });
  }
  if (answer.code !== 0) throw new LightcalError(answer.code, found.error ?? { code: 'internal', message: answer.err });
  return found;
}

// { fixture: "bulb", cct: "2900K", to: ["gltf", "json"] } as --fixture bulb --cct 2900K --to gltf,json
function optionWords(options = {}) {
  const words = [];
  for (const [key, value] of Object.entries(options)) {
    if (value === undefined || value === false) continue;
    const name = '--' + key.replace(/[A-Z]/g, (c) => '-' + c.toLowerCase());
    if (value === true) words.push(name);
    else words.push(name, Array.isArray(value) ? value.join(',') : String(value));
  }
  return words;
}

export const quick = (readings, options) => documentOf(['quick', ...readings, ...optionWords(options)]);
export const run = (session, options) => documentOf(['run', session, ...optionWords(options)]);
export const fit = (session, options) => documentOf(['fit', session, ...optionWords(options)]);
export const exportLights = (lights, options) => documentOf(['export', ...[lights].flat(), ...optionWords(options)]);
export const exposure = (options) => documentOf(['exposure', ...optionWords(options)]);
export const photometric = (file, options) => documentOf(['photometric', file, ...optionWords(options)]);
export const color = ({ xy, ...options }) =>
  documentOf(['color', ...(xy ? ['--xy', ...xy.map(String)] : []), ...optionWords(options)]);
export const ratio = (key, fill, options) => documentOf(['ratio', key, fill, ...optionWords(options)]);
