// SPDX-License-Identifier: Apache-2.0
// lightcal.wasm under node: compiled once, asked with words as a person types them there, the files
// node's own.
import fs from 'node:fs';
import process from 'node:process';
import { runCommand } from './wasi.js';
import { NodeFiles, ofFolder, ofWord } from './node_files.js';

let compiled;
export function lightcalModule() {
  compiled ??= new WebAssembly.Module(fs.readFileSync(new URL('./lightcal.wasm', import.meta.url)));
  return compiled;
}

// { code, out, err } of one command line in this folder; input: a function to its standard input.
export function nodeCommand(words, input) {
  const here = ofFolder(process.cwd());
  return runCommand(lightcalModule(), words.map((word) => ofWord(word)),
    { files: new NodeFiles(), here, environment: { ...process.env, PWD: here }, input });
}
