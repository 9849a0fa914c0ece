// SPDX-License-Identifier: Apache-2.0
// Loads a .usda with tinyusdz (WebAssembly made for browsers). Exit 0 = it parsed and type-checked.
//   node load.mjs MODULES FILE
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, file] = process.argv.slice(2);
globalThis.window = globalThis;
Object.defineProperty(process, 'type', { value: 'renderer' });
const folder = path.join(modules, 'node_modules', 'tinyusdz');
const { default: init } = await import(pathToFileURL(path.join(folder, 'tinyusdz.js')));
const wasmBinary = fs.readFileSync(path.join(folder, 'tinyusdz.wasm'));
const usd = await init({ wasmBinary, print: console.log, printErr: console.error });
const bytes = new Uint8Array(fs.readFileSync(file));
const layer = new usd.TinyUSDZLoaderNative();
if (!layer.loadAsLayerFromBinary(bytes, path.basename(file))) {
  console.error(layer.error());
  process.exit(1);
}
const stage = new usd.TinyUSDZLoaderNative();
if (!stage.loadFromBinary(bytes, path.basename(file))) {
  console.error(stage.error());
  process.exit(1);
}
console.log(layer.layerToString());
