// SPDX-License-Identifier: Apache-2.0
// A pipeline as TypeScript sees the package: compiled by tests/app/wasm/types/check, never run.
import { color, command, exportLights, exposure, LightcalError, quick, run } from 'lightcal';

const lamp = quick(['192lx@0.5m', '52lx@1m,card=5lx'], { fixture: 'bulb', cct: '2900K' });
const candela: number | undefined = lamp.lights[0].intensity_cd?.value;
const files: string[] = run('hall', { to: ['gltf', 'json'], force: true }).files;
const more: string[] = exportLights(files, { to: ['usd'], renderer: 'karma' }).files;
const [x, y]: [number, number] = color({ xy: [0.4476, 0.4074] }).xy;
const ev: number = exposure({ aperture: 'f/2.8', shutter: '1/60', iso: 100 }).ev100;
try {
  const answer = command(['quick', '52lx@1m'], { files: { '/lamp/session.toml': 'lightcal = 1' } });
  const held: Uint8Array | undefined = answer.files?.['/lamp/session.toml'];
  console.log(answer.code, held?.length, candela, more, x + y, ev);
} catch (error) {
  if (error instanceof LightcalError && error.exitCode === 3) console.error(error.code, error.subject ?? '');
}
// @ts-expect-error readings are texts
quick([192]);
// @ts-expect-error an answer has no such key
exposure({ aperture: 2.8 }).luminosity();
// @ts-expect-error a kind that no light has
const kind: 'candle' = lamp.lights[0].kind;
console.log(kind);
