// SPDX-License-Identifier: Apache-2.0
// Runs an exported module in Babylon.js and looks at a small white card where the meter stood.
import { Engine } from '/m/@babylonjs/core/Engines/engine.js';
import { Scene } from '/m/@babylonjs/core/scene.js';
import { Light } from '/m/@babylonjs/core/Lights/light.js';
import { PointLight } from '/m/@babylonjs/core/Lights/pointLight.js';
import { SpotLight } from '/m/@babylonjs/core/Lights/spotLight.js';
import { DirectionalLight } from '/m/@babylonjs/core/Lights/directionalLight.js';
import { HemisphericLight } from '/m/@babylonjs/core/Lights/hemisphericLight.js';
import { PBRMaterial } from '/m/@babylonjs/core/Materials/PBR/pbrMaterial.js';
import { RawTexture } from '/m/@babylonjs/core/Materials/Textures/rawTexture.js';
import { RenderTargetTexture } from '/m/@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { MeshBuilder } from '/m/@babylonjs/core/Meshes/meshBuilder.js';
import { Mesh } from '/m/@babylonjs/core/Meshes/mesh.js';
import { FreeCamera } from '/m/@babylonjs/core/Cameras/freeCamera.js';
import { Camera } from '/m/@babylonjs/core/Cameras/camera.js';
import { Vector3, Quaternion } from '/m/@babylonjs/core/Maths/math.vector.js';
import { Color3, Color4 } from '/m/@babylonjs/core/Maths/math.color.js';
import { Constants } from '/m/@babylonjs/core/Engines/constants.js';
import { AppendSceneAsync } from '/m/@babylonjs/core/Loading/sceneLoader.js';
import '/m/@babylonjs/core/Loading/loadingScreen.js';
import '/m/@babylonjs/core/Materials/Textures/baseTexture.polynomial.js';
import '/m/@babylonjs/loaders/glTF/2.0/index.js';

const BABYLON = { Engine, Scene, Light, PointLight, SpotLight, DirectionalLight, HemisphericLight,
  PBRMaterial, RawTexture, MeshBuilder, Mesh, FreeCamera, Vector3, Quaternion, Color3, Color4 };
const yUp = ([x, y, z]) => [x, z, -y];
const size = 0.02;

let engine, canvas;
function start() {
  if (engine) return;
  canvas = document.createElement('canvas');
  canvas.width = 600;
  canvas.height = 400;
  document.body.append(canvas);
  engine = new Engine(canvas, true, { preserveDrawingBuffer: true });
}

export async function babylon(job) {
  start();
  const module = await import(job.module);
  const scene = new Scene(engine);
  const built = module.buildBabylon(BABYLON, scene);
  if (job.edit) new Function('BABYLON', 'built', 'preset', job.edit)(BABYLON, built, module.preset);
  scene.activeCamera = built.camera;
  await scene.whenReadyAsync();
  let png;
  if (job.rig) {
    scene.render();
    png = canvas.toDataURL('image/png');
  }
  built.cards?.forEach((card) => card.dispose());
  const lux = await luxAt(scene, job.probes, module.preset.exposure.exposure);
  scene.dispose();
  return { version: Engine.Version, lux, png };
}

// The last scene of a .gltf, in which a dome is EXT_lights_image_based. Babylon clamps pixels at 30:
// its irradiance goes through the file's own exposure first.
export async function babylon_gltf(job) {
  start();
  const gltf = await (await fetch(job.module)).json();
  gltf.scene = gltf.scenes.length - 1;
  const k = gltf.scenes[0].extras.lightcal.exposure.exposure;
  for (const light of gltf.extensions.EXT_lights_image_based.lights) {
    light.irradianceCoefficients = light.irradianceCoefficients.map((c) => c.map((v) => v * k));
  }
  // A sun beside the dome, likewise; without one any light would be the dome's second.
  gltf.extensions.KHR_lights_punctual.lights.forEach((light) => { light.intensity *= k; });
  const scene = new Scene(engine);
  scene.useRightHandedSystem = true;
  await AppendSceneAsync(`data:${JSON.stringify(gltf)}`, scene, { pluginExtension: '.gltf' });
  if (scene.lights.length > (job.suns ?? 0)) throw new Error('the dome is lit twice');
  // Not the root, under which a sun hangs.
  scene.meshes.filter((mesh) => mesh.getTotalVertices() > 0).forEach((card) => card.dispose(true));
  const lux = await luxAt(scene, job.probes, k);
  scene.dispose();
  return { version: Engine.Version, lux, rgb: lux.rgb };
}

async function luxAt(scene, probes, k) {
  scene.imageProcessingConfiguration.applyByPostProcess = true;
  const lux = [], all = [];
  for (const { point, normal } of probes) {
    const at = new Vector3(...yUp(point));
    const n = new Vector3(...yUp(normal));
    const card = MeshBuilder.CreatePlane('probe', { size, sideOrientation: Mesh.DOUBLESIDE }, scene);
    const material = new PBRMaterial('probe', scene);
    material.albedoColor = new Color3(1, 1, 1);
    material.metallic = 0;
    material.roughness = 1;
    material.metallicF0Factor = 0;
    card.material = material;
    const side = Vector3.Cross(n, Math.abs(n.y) > 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0)).normalize();
    card.rotationQuaternion = Quaternion.RotationQuaternionFromAxis(side, Vector3.Cross(n, side), n);
    card.position = at;
    const eye = new FreeCamera('eye', at.add(n.scale(0.5)), scene);
    eye.mode = Camera.ORTHOGRAPHIC_CAMERA;
    eye.orthoLeft = eye.orthoBottom = -size / 4;
    eye.orthoRight = eye.orthoTop = size / 4;
    eye.minZ = 0.001;
    eye.upVector = side;
    eye.setTarget(at);
    const target = new RenderTargetTexture('target', 8, scene, { type: Constants.TEXTURETYPE_FLOAT });
    target.activeCamera = eye;
    target.renderList = [card];
    scene.activeCamera = eye;
    await scene.whenReadyAsync();
    while (!target.isReadyForRendering()) await new Promise((r) => setTimeout(r, 5));
    target.render();
    const pixels = await target.readPixels();
    let sum = 0;
    const rgb = [0, 0, 0];
    for (let i = 0; i < pixels.length; i += 4) {
      for (let c = 0; c < 3; ++c) rgb[c] += pixels[i + c];
      sum += 0.212639 * pixels[i] + 0.715169 * pixels[i + 1] + 0.072192 * pixels[i + 2];
    }
    lux.push(Math.PI * sum / (pixels.length / 4) / k);
    all.push(rgb);
    card.dispose();
    eye.dispose();
    target.dispose();
  }
  lux.rgb = all;
  return lux;
}
