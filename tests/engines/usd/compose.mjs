// SPDX-License-Identifier: Apache-2.0
// Composes a stage with the layers beside it that its subLayers name, and prints the one layer.
//   node compose.mjs MODULES STAGE LAYER...
import fs from 'node:fs';
import path from 'node:path';
import { openTinyUsdz } from './tinyusdz.mjs';

const [modules, file, ...layers] = process.argv.slice(2);
const usd = await openTinyUsdz(modules);
const stage = new usd.TinyUSDZLoaderNative();
const failed = (what) => {
  console.error(what + ' ' + stage.error());
  process.exit(1);
};
if (!stage.loadAsLayerFromBinary(new Uint8Array(fs.readFileSync(file)), path.basename(file))) failed('load');
for (const layer of layers) stage.setAsset('./' + path.basename(layer), new Uint8Array(fs.readFileSync(layer)));
if (!stage.composeSublayers()) failed('compose');
console.log(stage.layerToString());
