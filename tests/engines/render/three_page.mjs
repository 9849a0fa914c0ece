// SPDX-License-Identifier: Apache-2.0
// Runs an exported module in three.js and looks at a small white card where the meter stood.
import * as THREE from 'three';
import * as GPU from 'three/webgpu';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { IESLoader } from 'three/addons/loaders/IESLoader.js';
import { EXRExporter } from 'three/addons/exporters/EXRExporter.js';

const yUp = ([x, y, z]) => [x, z, -y];
const size = 0.02;
const luminance = (r, g, b) => 0.212639 * r + 0.715169 * g + 0.072192 * b;

function probe(T, scene, { point, normal }) {
  const material = new T.MeshPhysicalMaterial({ roughness: 1, metalness: 0, specularIntensity: 0 });
  const card = new T.Mesh(new T.PlaneGeometry(size, size), material);
  card.position.set(...yUp(point));
  card.lookAt(card.position.clone().add(new T.Vector3(...yUp(normal))));
  const half = size / 4;
  const eye = new T.OrthographicCamera(-half, half, half, -half, 0.001, 1);
  eye.position.copy(card.position).add(new T.Vector3(...yUp(normal)).multiplyScalar(0.01));
  eye.up.set(...(Math.abs(normal[2]) > 0.9 ? [1, 0, 0] : [0, 1, 0]));
  eye.lookAt(card.position);
  scene.add(card);
  return { card, eye };
}

function mean(pixels) {
  let sum = 0;
  for (let i = 0; i < pixels.length; i += 4) sum += luminance(pixels[i], pixels[i + 1], pixels[i + 2]);
  return sum / (pixels.length / 4);
}

// The rig as a page shows it: canvas, locked exposure, sRGB.
function showRig(renderer, module, built, job) {
  if (!job.rig) return {};
  renderer.setSize(600, 400);
  module.exposeThree(THREE, renderer);
  renderer.render(built.scene, built.camera);
  const png = renderer.domElement.toDataURL('image/png');
  if (!job.exr) return { png };
  const target = new THREE.WebGLRenderTarget(600, 400, { type: THREE.HalfFloatType });
  renderer.setRenderTarget(target);
  renderer.render(built.scene, built.camera);
  renderer.setRenderTarget(null);
  return { png, target };
}

// A chrome and a grey ball in the panorama, seen as `view` says, instead of the cards.
async function placeBalls(module, built, { balls, view }) {
  const { HDRLoader } = await import('three/addons/loaders/HDRLoader.js');
  const panorama = await module.panoramaOf(THREE, HDRLoader);
  built.scene.background = panorama;
  built.cards.forEach((card) => { card.visible = false; });
  for (const { at, radius, chrome } of balls) {
    const material = chrome
      ? new THREE.MeshStandardMaterial({ color: new THREE.Color(0.95, 0.95, 0.95), metalness: 1, roughness: 0, envMap: panorama })
      : new THREE.MeshPhysicalMaterial({ color: new THREE.Color(0.18, 0.18, 0.18), roughness: 1, specularIntensity: 0 });
    const ball = new THREE.Mesh(new THREE.SphereGeometry(radius, 96, 48), material);
    ball.position.set(...yUp(at));
    built.scene.add(ball);
    built.balls = [...(built.balls ?? []), ball];
  }
  const camera = new THREE.PerspectiveCamera(view.field_deg, 600 / 400, 0.05, 100);
  camera.position.set(...yUp(view.eye));
  camera.lookAt(...yUp(view.target));
  built.camera = camera;
}

let shared;
export async function three(job) {
  RectAreaLightUniformsLib.init();
  const module = await import(job.module);
  shared ??= new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  const renderer = shared;
  renderer.toneMapping = THREE.NoToneMapping;
  const built = module.buildThree(THREE);
  if (job.edit) new Function('THREE', 'built', 'preset', job.edit)(THREE, built, module.preset);
  if (job.balls) await placeBalls(module, built, job);
  const shown = showRig(renderer, module, built, job);
  let exr;
  if (shown.target) {
    const bytes = await new EXRExporter().parse(renderer, shown.target, { type: THREE.HalfFloatType });
    exr = btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(''));
  }
  renderer.toneMapping = THREE.NoToneMapping;
  built.cards?.forEach((card) => built.scene.remove(card));
  built.balls?.forEach((ball) => built.scene.remove(ball));
  const target = new THREE.WebGLRenderTarget(8, 8, { type: THREE.FloatType });
  if (job.environment) {
    // What three's own blur makes of the panorama, instead of the light probe.
    const { HDRLoader } = await import('three/addons/loaders/HDRLoader.js');
    built.scene.children.filter((thing) => thing.isLightProbe).forEach((thing) => built.scene.remove(thing));
    built.scene.environment = await module.panoramaOf(THREE, HDRLoader);
  }
  const rgb = [];
  const lux = job.probes.map((at) => {
    const { card, eye } = probe(THREE, built.scene, at);
    renderer.setRenderTarget(target);
    renderer.render(built.scene, eye);
    const pixels = new Float32Array(8 * 8 * 4);
    renderer.readRenderTargetPixels(target, 0, 0, 8, 8, pixels);
    renderer.setRenderTarget(null);
    built.scene.remove(card);
    rgb.push([0, 1, 2].map((c) => pixels.filter((_, i) => i % 4 === c).reduce((a, b) => a + b, 0)));
    return Math.PI * mean(pixels);
  });
  return { revision: THREE.REVISION, lux, rgb, png: shown.png, exr };
}

let gpu;
export async function three_ies(job) {
  const module = await import(job.module);
  if (!gpu) {
    gpu = new GPU.WebGPURenderer({ forceWebGL: true });
    await gpu.init();
  }
  const built = module.buildThree(GPU, { IESLoader });
  built.cards?.forEach((card) => built.scene.remove(card));
  const lux = [];
  for (const at of job.probes) {
    const target = new GPU.RenderTarget(8, 8, { type: GPU.FloatType });
    const { card, eye } = probe(GPU, built.scene, at);
    gpu.toneMapping = GPU.NoToneMapping;
    gpu.setRenderTarget(target);
    await gpu.renderAsync(built.scene, eye);
    const pixels = await gpu.readRenderTargetPixelsAsync(target, 0, 0, 8, 8);
    gpu.setRenderTarget(null);
    built.scene.remove(card);
    lux.push(Math.PI * mean(pixels));
  }
  return { revision: GPU.REVISION, lux };
}
