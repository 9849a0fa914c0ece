#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// lightcal on the command line of node: the arithmetic and the texts are lightcal.wasm's.
import fs from 'node:fs';
import process from 'node:process';
import { runCommand } from './wasi.js';
import { NodeFiles, ofFolder, ofWord } from './node_files.js';

const wasm = fs.readFileSync(new URL('./lightcal.wasm', import.meta.url));
const module = new WebAssembly.Module(wasm);
const answer = runCommand(module, process.argv.slice(2).map((word) => ofWord(word)), {
  files: new NodeFiles(),
  here: ofFolder(process.cwd()),
  environment: { ...process.env, PWD: ofFolder(process.cwd()) },
  input: () => new Uint8Array(fs.readFileSync(0)),
});
fs.writeSync(2, answer.err);
fs.writeSync(1, answer.out);
process.exitCode = answer.code;
