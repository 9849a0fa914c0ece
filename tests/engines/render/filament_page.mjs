// SPDX-License-Identifier: Apache-2.0
// Builds the lights of an exported .filament.json in Filament and looks at a white card where the
// meter stood. The card is glTF, for its lit material; pixels are 8 bit.
const yUp = ([x, y, z]) => [x, z, -y];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (v) => v.map((x) => x / Math.hypot(...v));
const plus = (p, v, s) => p.map((x, i) => x + v[i] * s);
const kRigSize = [600, 400], kProbeSize = [192, 128];
const kMirror = 0.3;  // of a mirror, whose rgb is what it shows
const kProbe = 0.4;  // no channel of a warm lamp above 1

function base64(bytes) {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

// [{centre, row, normal, side}] or [{centre, radius}], each of a `reflectance`, `mirror` or matt.
function meshOf(card) {
  if (!card.radius) {
    const up = cross(card.normal, card.row);
    const points = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) =>
      plus(plus(card.centre, card.row, a * card.side / 2), up, b * card.side / 2));
    return { points, normals: points.map(() => card.normal), indices: [0, 1, 2, 0, 2, 3] };
  }
  const across = 96, down = 48, normals = [], indices = [];
  for (let j = 0; j <= down; ++j) for (let i = 0; i <= across; ++i) {
    const u = 2 * Math.PI * i / across, v = Math.PI * j / down;
    normals.push([Math.sin(v) * Math.sin(u), Math.cos(v), Math.sin(v) * Math.cos(u)]);
    const at = j * (across + 1) + i;
    if (i < across && j < down) indices.push(at, at + across + 1, at + 1, at + 1, at + across + 1, at + across + 2);
  }
  return { points: normals.map((n) => plus(card.centre, n, card.radius)), normals, indices };
}

// As a glTF, places and directions Y up.
function shapes(cards) {
  const chunks = [];
  let length = 0;
  const gltf = { asset: { version: '2.0' }, extensionsUsed: ['KHR_materials_specular'], scene: 0,
    scenes: [{ nodes: [] }], nodes: [], meshes: [], materials: [], accessors: [], bufferViews: [], buffers: [] };
  const add = (array, componentType, type, count, more) => {
    gltf.bufferViews.push({ buffer: 0, byteOffset: length, byteLength: array.byteLength });
    gltf.accessors.push({ bufferView: gltf.bufferViews.length - 1, componentType, count, type, ...more });
    chunks.push(new Uint8Array(array.buffer));
    length += array.byteLength;
    if (length % 4) { chunks.push(new Uint8Array(4 - length % 4)); length += 4 - length % 4; }
    return gltf.accessors.length - 1;
  };
  cards.forEach((card, i) => {
    const { points, normals, indices } = meshOf(card);
    const ends = (f) => [0, 1, 2].map((k) => f(...points.map((c) => Math.fround(c[k]))));
    const attributes = {
      POSITION: add(new Float32Array(points.flat()), 5126, 'VEC3', points.length, { min: ends(Math.min), max: ends(Math.max) }),
      NORMAL: add(new Float32Array(normals.flat()), 5126, 'VEC3', normals.length) };
    const list = add(new Uint16Array(indices), 5123, 'SCALAR', indices.length);
    gltf.nodes.push({ mesh: i, name: `card ${i}` });
    gltf.scenes[0].nodes.push(i);
    const r = card.reflectance;
    gltf.materials.push({ pbrMetallicRoughness: { baseColorFactor: [r, r, r, 1],
      metallicFactor: card.mirror ? 1 : 0, roughnessFactor: card.mirror ? 0 : 1 },
      extensions: card.mirror ? {} : { KHR_materials_specular: { specularFactor: 0 } } });
    gltf.meshes.push({ primitives: [{ attributes, indices: list, material: i }] });
  });
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const chunk of chunks) { bytes.set(chunk, at); at += chunk.length; }
  gltf.buffers.push({ byteLength: length, uri: 'data:application/octet-stream;base64,' + base64(bytes) });
  return new TextEncoder().encode(JSON.stringify(gltf));
}

async function addLights(F, engine, scene, preset, folder) {
  for (const light of preset.lights) {
    if (light.picture) {
      const ktx = new Uint8Array(await (await fetch(folder + light.picture)).arrayBuffer());
      scene.setIndirectLight(F.IndirectLight.Builder().reflections(engine.createTextureFromKtx1(ktx))
        .irradianceSh(3, light.irradiance.flat()).intensity(light.intensity).build(engine));
      scene.setSkybox(engine.createSkyFromKtx1(ktx));
      continue;
    }
    if (light.type === 'INDIRECT') {
      const ibl = F.IndirectLight.Builder().irradianceSh(light.irradiance ? 3 : 1, light.irradiance ? light.irradiance.flat() : light.color).intensity(light.intensity).build(engine);
      scene.setIndirectLight(ibl);
      continue;
    }
    const entity = F.EntityManager.get().create();
    const builder = F.LightManager.Builder(F.LightManager$Type[light.type])
      .color(light.color).intensity(light.intensity_lx ?? light.intensity_lm).direction(light.direction);
    if (light.falloff_m) builder.position(light.position_m).falloff(light.falloff_m);
    if (light.outer_rad) builder.spotLightCone(light.inner_rad, light.outer_rad);
    builder.build(engine, entity);
    scene.addEntity(entity);
  }
}

const decode = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);

// One engine for all pictures of a job: the cards of one at a time, looked at by its own camera.
async function stage(F, preset, cards, unlocked, [W, H], folder) {
  const canvas = document.createElement('canvas');
  canvas.width = W;
  canvas.height = H;
  document.body.append(canvas);
  const engine = F.Engine.create(canvas, { preserveDrawingBuffer: true, alpha: false });
  const scene = engine.createScene();
  const renderer = engine.createRenderer();
  const swapChain = engine.createSwapChain();
  renderer.setClearOptions({ clearColor: [0, 0, 0, 1], clear: true });
  const view = engine.createView();
  const camera = engine.createCamera(F.EntityManager.get().create());
  const { aperture, shutter_s, iso } = preset.exposure;
  if (!unlocked) camera.setExposure(aperture, shutter_s, iso);
  view.setCamera(camera);
  view.setScene(scene);
  view.setViewport([0, 0, W, H]);
  view.setColorGrading(F.ColorGrading.Builder().quality(F.ColorGrading$QualityLevel.ULTRA).toneMapping(F.ColorGrading$ToneMapping.LINEAR).build(engine));
  const asset = engine.createAssetLoader().createAsset(shapes(cards));
  await new Promise((done) => asset.loadResources(done, null, null));
  await addLights(F, engine, scene, preset, folder);
  const entities = cards.map((_, i) => asset.getFirstEntityByName(`card ${i}`));
  let shown = [], warm = false;
  return {
    async picture(which, eye) {
      shown.forEach((e) => scene.remove(e));
      shown = which.map((i) => entities[i]);
      shown.forEach((e) => scene.addEntity(e));
      camera.setProjectionFov(eye.fov, W / H, 0.01, 100, F.Camera$Fov.VERTICAL);
      camera.lookAt(eye.position, eye.target, eye.up);
      // The first pictures come before the shaders.
      for (let i = 0; i < (warm ? 2 : 6); ++i) {
        renderer.render(swapChain, view);
        await new Promise((r) => setTimeout(r, 20));
      }
      warm = true;
      engine.execute();
      const png = canvas.toDataURL('image/png');
      const flat = new OffscreenCanvas(W, H).getContext('2d');
      flat.drawImage(canvas, 0, 0);
      return { png, data: flat.getImageData(0, 0, W, H).data };
    },
    close() {
      canvas.remove();
      F.Engine.destroy(engine);
    },
  };
}
let ready;
export async function filament(job) {
  ready ??= new Promise((done) => window.Filament.init([], done));
  await ready;
  const F = window.Filament;
  const preset = await (await fetch(job.module)).json();
  if (job.edit) new Function('preset', job.edit)(preset);
  const folder = job.module.slice(0, job.module.lastIndexOf('/') + 1);
  let png;
  if (job.view) {
    const balls = job.balls.map((b) => ({ centre: yUp(b.at), radius: b.radius, reflectance: b.chrome ? 0.95 : 0.18, mirror: b.chrome }));
    const placed = await stage(F, preset, balls, false, kRigSize, folder);
    const { eye, target, field_deg } = job.view;
    png = (await placed.picture(balls.map((_, i) => i), { position: yUp(eye), target: yUp(target), up: [0, 1, 0], fov: field_deg })).png;
    placed.close();
  } else if (job.rig) {
    const rig = preset.rig;
    const cards = rig.cards.map((c) => ({ centre: c.centre_m, row: rig.row, normal: rig.normal, side: rig.side_m, reflectance: c.reflectance }));
    const { position_m, target_m, up, vertical_fov_deg } = rig.camera;
    const rigged = await stage(F, preset, cards, job.unlocked, kRigSize, folder);
    png = (await rigged.picture(cards.map((_, i) => i), { position: position_m, target: target_m, up, fov: vertical_fov_deg })).png;
    rigged.close();
  }
  const lux = [], rgb = [];
  const probes = job.probes.map(({ point, normal, mirror }) => {
    const n = yUp(normal);
    const row = unit(cross(Math.abs(n[1]) > 0.9 ? [1, 0, 0] : [0, 1, 0], n));
    return { centre: yUp(point), row, normal: n, side: 0.2, mirror, reflectance: mirror ? kMirror : kProbe };
  });
  const probed = probes.length ? await stage(F, preset, probes, false, kProbeSize, folder) : null;
  for (const [i, { centre, row, normal }] of probes.entries()) {
    const { data } = await probed.picture([i], { position: plus(centre, normal, 0.3), target: centre, up: cross(normal, row), fov: 15 });
    const [W, H] = kProbeSize;
    const mid = ((H / 2) * W + W / 2) * 4;
    let sum = [0, 0, 0];
    for (let y = -2; y < 2; ++y) for (let x = -2; x < 2; ++x) {
      const at = mid + 4 * (y * W + x);
      for (let c = 0; c < 3; ++c) sum[c] += decode(data[at + c] / 255) / 16;
    }
    const pixel = 0.212639 * sum[0] + 0.715169 * sum[1] + 0.072192 * sum[2];
    rgb.push(sum.map((v) => v / (probes[i].mirror ? kMirror * preset.exposure.exposure : 1)));
    lux.push(Math.PI * pixel / kProbe / preset.exposure.exposure);
  }
  probed?.close();
  return { lux, rgb, png };
}
