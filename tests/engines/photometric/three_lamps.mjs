// SPDX-License-Identifier: Apache-2.0
// node three_lamps.mjs FOLDER_WITH_NODE_MODULES FILE.mjs [webgl]
// Prints the lamps that an exported file builds with three.js: of a spot its cone, and the row of its map that
// runs through the axis; of an IES light the rows of its texture.
import { pathToFileURL } from 'node:url';
const [, , modules, file, webgl] = process.argv;
const from = (path) => import(pathToFileURL(`${modules}/node_modules/three/${path}`));
const THREE = await from('build/three.module.js');
const { IESLoader } = await from('examples/jsm/loaders/IESLoader.js');
class IESSpotLight extends THREE.SpotLight {}  // as three.webgpu.js has it, which needs a browser
const { buildThree } = await import(pathToFileURL(file));
const { lights } = webgl ? buildThree(THREE) : buildThree({ ...THREE, IESSpotLight }, { IESLoader });
const number = THREE.DataUtils.fromHalfFloat;
console.log(JSON.stringify(lights.map((l) => {
  const row = (data, at, count, step) => Array.from({ length: count }, (_, i) => number(data[at + i * step]));
  const map = !l.map ? null : { size: l.map.image.width,
    row: row(l.map.image.data, l.map.image.width * l.map.image.width * 2, l.map.image.width, 4) };
  const ies = !l.iesMap ? null : Array.from({ length: l.iesMap.image.height }, (_, y) => row(l.iesMap.image.data, y * 180, 180, 1));
  return { name: l.name, intensity: l.intensity, color: l.color.toArray(), angle: l.angle, penumbra: l.penumbra, map, ies };
})));
