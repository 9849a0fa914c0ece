// Written by lightcal: measured lights for three.js (r155 and later) and Babylon.js.
//   import * as THREE from 'three';
//   import { buildThree, exposeThree } from './THIS_FILE';
//   const { scene, camera } = buildThree(THREE);     exposeThree(THREE, renderer);
//   renderer.render(scene, camera);
// Rectangles need RectAreaLightUniformsLib.init() first; measured distributions take { IESLoader }
// and the WebGPU build, else their mean round the aim is projected. Right-handed, Y up, metres;
// cd, lx and cd/m2 divided by the luminance of the colour; exposure turns cd/m2 into pixels.
export const preset = @DATA@;

const of = (light, able) => (able(light) || !light.fallback ? light
  : { ...light, profile: undefined, ...light.fallback });

// ---- three.js ----

function frame(THREE, object, light) {
  const [x, y, z] = light.axes.map((v) => new THREE.Vector3(...v));
  object.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, z));
}

// A beam itself, projected: three's cone is a smoothstep and nothing else. Spots wider than 80
// degrees keep the cone; a measured beam does where it has more beyond them than the cone strays.
const widestProjected = 80 * Math.PI / 180;

function beamEnd(profile) {
  let last = 0;
  profile.forEach((v, i) => { if (v > 1e-3) last = i; });
  return ((last + 1.5) * Math.PI) / profile.length;
}

function profileAt(profile, angle) {
  const at = Math.max(0, (angle / Math.PI) * profile.length - 0.5);
  const i = Math.min(Math.floor(at), profile.length - 2);
  return profile[i] + (profile[i + 1] - profile[i]) * Math.min(1, at - i);
}

function squaredAt(light, angle) {
  const rim = Math.cos(light.outer_rad);
  const t = (Math.cos(angle) - rim) / Math.max(1e-12, Math.cos(light.inner_rad) - rim);
  return Math.min(1, Math.max(0, t)) ** 2;
}

function threeProjected(THREE, color, light) {
  const { half_angle_rad: angle, texels: size } = light.projected
    ?? { half_angle_rad: Math.min(beamEnd(light.profile), widestProjected) * 1.03 + 0.005, texels: 1024 };
  const partAt = (at) => (light.projected ? squaredAt(light, at) : profileAt(light.profile, at));
  const texels = new Uint16Array(size * size * 4);
  const half = THREE.DataUtils.toHalfFloat;
  const one = half(1);
  for (let y = 0, t = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x, t += 4) {
      const r = Math.hypot(2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1);
      const v = half(partAt(Math.atan(r * Math.tan(angle))));
      texels[t] = texels[t + 1] = texels[t + 2] = v;
      texels[t + 3] = one;
    }
  }
  const map = new THREE.DataTexture(texels, size, size, THREE.RGBAFormat, THREE.HalfFloatType);
  map.minFilter = map.magFilter = THREE.LinearFilter;
  map.needsUpdate = true;
  const lamp = new THREE.SpotLight(color, light.intensity, light.range_m ?? 0, angle, 0.01, 2);
  lamp.map = map;
  lamp.shadow.camera.near = 0.01;  // outside of the shadow camera the map is ignored
  lamp.shadow.camera.far = 1000;
  return lamp;
}

function threeLight(THREE, light, options) {
  const color = new THREE.Color().setRGB(...light.color, THREE.LinearSRGBColorSpace);
  let lamp;
  if (light.type === 'point') lamp = new THREE.PointLight(color, light.intensity, light.range_m ?? 0, 2);
  if (light.type === 'spot' && (light.projected ?? light.profile)) lamp = threeProjected(THREE, color, light);
  else if (light.type === 'spot') {
    const cone = light.three ?? light;
    lamp = new THREE.SpotLight(color, light.intensity, light.range_m ?? 0, cone.outer_rad,
      1 - cone.inner_rad / cone.outer_rad, 2);
  }
  if (light.type === 'ies') {
    lamp = new THREE.IESSpotLight(color, light.intensity, light.range_m ?? 0, Math.PI / 2, 0, 2);
    lamp.iesMap = new options.IESLoader().parse(light.ies);
  }
  if (light.type === 'directional') lamp = new THREE.DirectionalLight(color, light.intensity);
  if (light.type === 'rect') {
    lamp = new THREE.RectAreaLight(color, light.intensity, light.width_m, light.height_m);
    frame(THREE, lamp, light);
  }
  lamp.name = light.name;
  lamp.position.set(...light.position_m);
  if (lamp.target) {
    lamp.target.position.copy(lamp.position).add(new THREE.Vector3(...light.direction));
  }
  lamp.userData.lightcal = light.measured;
  return lamp;
}

// What a matt surface gets of a panorama, to second order.
function threeProbe(THREE, scene, light) {
  const probe = new THREE.LightProbe(
    new THREE.SphericalHarmonics3().set(light.harmonics.map((c) => new THREE.Vector3(...c))), 1);
  probe.name = light.name;
  probe.userData.lightcal = light.measured;
  scene.add(probe);
}

/** The panorama seen, and in mirrors: await it after buildThree, with three's HDRLoader (RGBELoader
 * before r180). Matt surfaces are lit by its light probe, which three's own blur is 2-6 % beside: so
 * give it as background and as envMap of shiny materials, and not as scene.environment. */
export async function panoramaOf(THREE, HDRLoader, base = import.meta.url) {
  const light = preset.lights.find((one) => one.picture);
  if (!light) return null;
  const loader = new HDRLoader();
  loader.setDataType(THREE.FloatType);
  const sky = await loader.loadAsync(new URL(light.picture, base).href);
  const { data, width, height } = sky.image;
  // The picture's middle looks along -Z; three looks along +X there. And three counts rows from
  // below, as its loader does.
  const channels = data.length / width / height;
  const quarter = width / 4;
  const turned = new Uint16Array(data.length);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const from = (y * width + (x + quarter) % width) * channels;
      const to = (y * width + x) * channels;
      for (let c = 0; c < channels; ++c) {
        turned[to + c] = THREE.DataUtils.toHalfFloat(Math.min(65504, data[from + c]));
      }
    }
  }
  const map = new THREE.DataTexture(turned, width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  map.mapping = THREE.EquirectangularReflectionMapping;
  map.minFilter = map.magFilter = THREE.LinearFilter;
  map.flipY = sky.flipY;
  map.needsUpdate = true;
  return map;
}

function threeDome(THREE, scene, light) {
  if (light.harmonics) {
    threeProbe(THREE, scene, light);
    return;
  }
  const texels = new Float32Array(32 * 16 * 4);
  for (let i = 0; i < texels.length; i += 4) texels.set([...light.color, 1], i);
  const sky = new THREE.DataTexture(texels, 32, 16, THREE.RGBAFormat, THREE.FloatType);
  sky.mapping = THREE.EquirectangularReflectionMapping;
  sky.minFilter = sky.magFilter = THREE.LinearFilter;
  sky.needsUpdate = true;
  scene.environment = sky;
  scene.environmentIntensity = light.intensity;
  scene.background = sky;
  scene.backgroundIntensity = light.intensity;
}

function threeCard(THREE, rig, card) {
  const material = new THREE.MeshPhysicalMaterial({ roughness: 1, metalness: 0, specularIntensity: 0 });
  material.color.setRGB(card.reflectance, card.reflectance, card.reflectance, THREE.LinearSRGBColorSpace);
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(rig.side_m, rig.side_m), material);
  mesh.name = card.name;
  const row = new THREE.Vector3(...rig.row);
  const normal = new THREE.Vector3(...rig.normal);
  const basis = new THREE.Matrix4().makeBasis(row, normal.clone().cross(row), normal);
  mesh.quaternion.setFromRotationMatrix(basis);
  mesh.position.set(...card.centre_m);
  return mesh;
}

function threeCamera(THREE, rig) {
  const { position_m, target_m, up, vertical_fov_deg, aspect_ratio } = rig.camera;
  const camera = new THREE.PerspectiveCamera(vertical_fov_deg, aspect_ratio, 0.01, 10000);
  camera.up.set(...up);
  camera.position.set(...position_m);
  camera.lookAt(...target_m);
  return camera;
}

/** The lights (and cards and camera) as a new scene, in cd/m2 before exposure. */
export function buildThree(THREE, options = {}) {
  // Without the WebGPU build's IES lights a measured beam is projected.
  const projected = (light) => {
    const { profile, fallback } = light;
    const from = Math.floor((widestProjected / Math.PI) * profile.length);
    const cut = Math.max(...profile.slice(from)) / Math.max(1e-9, profile[0]);
    const cone = Math.max(1e-3, fallback?.three?.worst_of_axial ?? 0);
    return cut > cone ? light : { ...light, type: 'spot', fallback: undefined };
  };
  const able = (light) => light.type !== 'ies' || (THREE.IESSpotLight && options.IESLoader);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0, 0, 0);
  const lights = [];
  for (const given of preset.lights) {
    const light = of(able(given) ? given : projected(given), able);
    if (light.type === 'dome') {
      threeDome(THREE, scene, light);
      continue;
    }
    const lamp = threeLight(THREE, light, options);
    lights.push(lamp);
    scene.add(lamp);
    if (lamp.target) scene.add(lamp.target);
  }
  if (!preset.rig) return { scene, lights };
  const cards = preset.rig.cards.map((card) => threeCard(THREE, preset.rig, card));
  cards.forEach((card) => scene.add(card));
  return { scene, lights, cards, camera: threeCamera(THREE, preset.rig) };
}

/** Locks the renderer's exposure: a white card of reflectance 1 shows as 1.0. */
export function exposeThree(THREE, renderer) {
  renderer.toneMapping = THREE.LinearToneMapping;
  renderer.toneMappingExposure = preset.exposure.exposure;
}

// ---- Babylon.js ----
// Its shaders clamp light at 30, so intensities are pre-exposed: pixels come out as they go on the
// screen. No sphere, rect, disk: those are the best point or spot.

// Texel i is the direction (i + .5)/n of half a turn from the axis: Babylon's own loader puts its
// texels half a degree off, 7 % at 60 degrees of cos^4.
function babylonProfile(BABYLON, scene, profile) {
  const format = 6, bilinear = 2, float = 1;  // Constants.TEXTUREFORMAT_R ...
  return new BABYLON.RawTexture(Float32Array.from(profile), profile.length, 1, format, scene, false,
    false, bilinear, float);
}

function babylonLight(BABYLON, scene, light) {
  const at = new BABYLON.Vector3(...light.position_m);
  const direction = new BABYLON.Vector3(...light.direction);
  let lamp;
  if (light.type === 'point') lamp = new BABYLON.PointLight(light.name, at, scene);
  if (light.type === 'directional') lamp = new BABYLON.DirectionalLight(light.name, direction, scene);
  if (light.type === 'spot') {
    lamp = new BABYLON.SpotLight(light.name, at, direction, 2 * light.outer_rad, 0, scene);
    lamp.innerAngle = 2 * light.inner_rad;
  }
  if (light.type === 'ies') {
    lamp = new BABYLON.SpotLight(light.name, at, direction, Math.PI, 0, scene);
    lamp.innerAngle = Math.PI;
    lamp.iesProfileTexture = babylonProfile(BABYLON, scene, light.profile);
  }
  if (light.type === 'dome') {
    lamp = new BABYLON.HemisphericLight(light.name, new BABYLON.Vector3(0, 1, 0), scene);
    lamp.groundColor = new BABYLON.Color3(...(light.below ?? light.color));
  }
  const isDirectional = light.type === 'directional';
  if (light.type !== 'dome') {
    lamp.falloffType = BABYLON.Light.FALLOFF_GLTF;
    lamp.intensityMode = isDirectional ? BABYLON.Light.INTENSITYMODE_ILLUMINANCE
      : BABYLON.Light.INTENSITYMODE_LUMINOUSINTENSITY;
    if (!isDirectional) lamp.range = light.range_m ?? 10000;
  }
  lamp.diffuse = new BABYLON.Color3(...(light.above ?? light.color));
  lamp.specular = lamp.diffuse;
  lamp.intensity = light.intensity * (light.babylon_intensity_factor ?? 1) * preset.exposure.exposure;
  lamp.metadata = { lightcal: light.measured };
  return lamp;
}

function babylonCard(BABYLON, scene, rig, card) {
  const mesh = BABYLON.MeshBuilder.CreatePlane(card.name, { size: rig.side_m }, scene);
  const material = new BABYLON.PBRMaterial(card.name, scene);
  material.albedoColor = new BABYLON.Color3(card.reflectance, card.reflectance, card.reflectance);
  material.metallic = 0;
  material.roughness = 1;
  material.metallicF0Factor = 0;
  material.brdf.baseDiffuseModel = 2;  // Lambert, in Constants; the default darkens when seen aslant
  material.backFaceCulling = false;
  material.twoSidedLighting = false;
  material.maxSimultaneousLights = Math.max(4, preset.lights.length);  // Babylon stops at 4
  mesh.material = material;
  const row = new BABYLON.Vector3(...rig.row);
  const normal = new BABYLON.Vector3(...rig.normal);
  // A plane of Babylon's faces its own -z.
  mesh.rotationQuaternion = BABYLON.Quaternion.RotationQuaternionFromAxis(
    row, BABYLON.Vector3.Cross(row, normal), normal.scale(-1));
  mesh.position.set(...card.centre_m);
  return mesh;
}

function babylonCamera(BABYLON, scene, rig) {
  const camera = new BABYLON.FreeCamera('rig camera', new BABYLON.Vector3(...rig.camera.position_m), scene);
  camera.upVector = new BABYLON.Vector3(...rig.camera.up);
  camera.fov = rig.camera.vertical_fov_deg * Math.PI / 180;
  camera.minZ = 0.01;
  camera.maxZ = 10000;
  camera.setTarget(new BABYLON.Vector3(...rig.camera.target_m));
  return camera;
}

/** Into an empty Babylon scene. Measured distributions are round: the mean of all C planes. */
export function buildBabylon(BABYLON, scene) {
  const able = (light) => light.type !== 'rect' && (light.type !== 'ies' || BABYLON.RawTexture);
  scene.useRightHandedSystem = true;
  scene.clearColor = new BABYLON.Color4(0, 0, 0, 1);
  scene.imageProcessingConfiguration.toneMappingEnabled = false;
  scene.imageProcessingConfiguration.exposure = 1;
  scene.imageProcessingConfiguration.contrast = 1;
  const lights = preset.lights.map((light) => babylonLight(BABYLON, scene, of(light, able)));
  if (!preset.rig) return { lights };
  const cards = preset.rig.cards.map((card) => babylonCard(BABYLON, scene, preset.rig, card));
  return { lights, cards, camera: babylonCamera(BABYLON, scene, preset.rig) };
}
