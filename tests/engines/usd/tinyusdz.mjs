// SPDX-License-Identifier: Apache-2.0
// tinyusdz, WebAssembly made for browsers, in node.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

// modules: the folder that holds its node_modules.
export async function openTinyUsdz(modules) {
  globalThis.window = globalThis;
  Object.defineProperty(process, 'type', { value: 'renderer' });
  const folder = path.join(modules, 'node_modules', 'tinyusdz');
  const { default: init } = await import(pathToFileURL(path.join(folder, 'tinyusdz.js')));
  const wasmBinary = fs.readFileSync(path.join(folder, 'tinyusdz.wasm'));
  return init({ wasmBinary, print: console.log, printErr: console.error });
}
