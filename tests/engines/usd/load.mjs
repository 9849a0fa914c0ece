// SPDX-License-Identifier: Apache-2.0
// Loads a .usda with tinyusdz (WebAssembly made for browsers). Exit 0 = it parsed and type-checked.
//   node load.mjs MODULES FILE
import fs from 'node:fs';
import path from 'node:path';
import { openTinyUsdz } from './tinyusdz.mjs';

const [modules, file] = process.argv.slice(2);
const usd = await openTinyUsdz(modules);
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
