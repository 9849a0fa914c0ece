// SPDX-License-Identifier: Apache-2.0
// node read_ies.mjs FOLDER_WITH_NODE_MODULES FILE.ies
// Prints what three.js's IESLoader makes of the file: the planes of its texture, one row of 180
// values from nadir to zenith for each, relative to the peak.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
const [, , modules, file] = process.argv;
const from = (path) => import(pathToFileURL(`${modules}/node_modules/three/${path}`));
const THREE = await from('build/three.module.js');
const { IESLoader } = await from('examples/jsm/loaders/IESLoader.js');
const loader = new IESLoader();
loader.type = THREE.FloatType;
const { image } = loader.parse(readFileSync(file, 'latin1'));
const rows = [];
for (let y = 0; y < image.height; ++y) {
  rows.push(Array.from(image.data.slice(y * image.width, (y + 1) * image.width)));
}
console.log(JSON.stringify({ revision: THREE.REVISION, rows }));
