#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// lightcal on the command line of node: the arithmetic and the texts are lightcal.wasm's.
import fs from 'node:fs';
import process from 'node:process';
import { nodeCommand } from './node_command.js';

const answer = nodeCommand(process.argv.slice(2), () => new Uint8Array(fs.readFileSync(0)));
fs.writeSync(2, answer.err);
fs.writeSync(1, answer.out);
process.exitCode = answer.code;
