// SPDX-License-Identifier: Apache-2.0
// Builds the lights of an exported .filament.json in Filament and looks at a white card where the
// meter stood. The card is glTF, for its lit material; pixels are 8 bit.
const yUp = ([x, y, z]) => [x, z, -y];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (v) => v.map((x) => x / Math.hypot(...v));
const plus = (p, v, s) => p.map((x, i) => x + v[i] * s);
const W = 600, H = 400;
const kProbe = 0.4;  // no channel of a warm lamp above 1

function base64(bytes) { return btoa(String.fromCharCode(...bytes)); }

// Squares as a glTF: [{centre, row, normal, side, reflectance}], places and directions Y up.
function squares(cards) {
  const bytes = new Uint8Array(4 * 3 * 4 * 2 * cards.length + 12);
  const view = new DataView(bytes.buffer);
  let at = 0;
  const put = (v) => v.forEach((x) => { view.setFloat32(at, x, true); at += 4; });
  const gltf = { asset: { version: '2.0' }, extensionsUsed: ['KHR_materials_specular'], scene: 0,
    scenes: [{ nodes: [] }], nodes: [], meshes: [], materials: [], accessors: [], bufferViews: [], buffers: [] };
  cards.forEach((card, i) => {
    const up = cross(card.normal, card.row);
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) =>
      plus(plus(card.centre, card.row, a * card.side / 2), up, b * card.side / 2));
    const start = at;
    corners.forEach(put);
    corners.forEach(() => put(card.normal));
    gltf.bufferViews.push({ buffer: 0, byteOffset: start, byteLength: 48 }, { buffer: 0, byteOffset: start + 48, byteLength: 48 });
    const low = [0, 1, 2].map((k) => Math.min(...corners.map((c) => c[k])));
    const high = [0, 1, 2].map((k) => Math.max(...corners.map((c) => c[k])));
    gltf.accessors.push({ bufferView: 2 * i, componentType: 5126, count: 4, type: 'VEC3', min: low, max: high },
      { bufferView: 2 * i + 1, componentType: 5126, count: 4, type: 'VEC3' });
    gltf.nodes.push({ mesh: i });
    gltf.scenes[0].nodes.push(i);
    const r = card.reflectance;
    gltf.materials.push({ pbrMetallicRoughness: { baseColorFactor: [r, r, r, 1], metallicFactor: 0, roughnessFactor: 1 },
      extensions: { KHR_materials_specular: { specularFactor: 0 } } });
    gltf.meshes.push({ primitives: [{ attributes: { POSITION: 2 * i, NORMAL: 2 * i + 1 }, indices: 2 * cards.length, material: i }] });
  });
  [0, 1, 2, 0, 2, 3].forEach((v) => { view.setUint16(at, v, true); at += 2; });
  gltf.bufferViews.push({ buffer: 0, byteOffset: at - 12, byteLength: 12 });
  gltf.accessors.push({ bufferView: 2 * cards.length, componentType: 5123, count: 6, type: 'SCALAR' });
  gltf.buffers.push({ byteLength: bytes.length, uri: 'data:application/octet-stream;base64,' + base64(bytes) });
  return new TextEncoder().encode(JSON.stringify(gltf));
}

function addLights(F, engine, scene, preset) {
  for (const light of preset.lights) {
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

async function picture(F, preset, cards, eye, job) {
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
  if (!job.unlocked) camera.setExposure(aperture, shutter_s, iso);
  camera.setProjectionFov(eye.fov, W / H, 0.01, 100, F.Camera$Fov.VERTICAL);
  camera.lookAt(eye.position, eye.target, eye.up);
  view.setCamera(camera);
  view.setScene(scene);
  view.setViewport([0, 0, W, H]);
  view.setColorGrading(F.ColorGrading.Builder().quality(F.ColorGrading$QualityLevel.ULTRA).toneMapping(F.ColorGrading$ToneMapping.LINEAR).build(engine));
  const loader = engine.createAssetLoader();
  const asset = loader.createAsset(squares(cards));
  await new Promise((done) => asset.loadResources(done, null, null));
  scene.addEntities(asset.getEntities ? asset.getEntities() : asset.getRenderableEntities());
  addLights(F, engine, scene, preset);
  for (let i = 0; i < 6; ++i) {
    renderer.render(swapChain, view);
    await new Promise((r) => setTimeout(r, 20));
  }
  engine.execute();
  const png = canvas.toDataURL('image/png');
  const flat = new OffscreenCanvas(W, H).getContext('2d');
  flat.drawImage(canvas, 0, 0);
  const { data } = flat.getImageData(0, 0, W, H);
  canvas.remove();
  F.Engine.destroy(engine);
  return { png, data };
}
let ready;
export async function filament(job) {
  ready ??= new Promise((done) => window.Filament.init([], done));
  await ready;
  const F = window.Filament;
  const preset = await (await fetch(job.module)).json();
  if (job.edit) new Function('preset', job.edit)(preset);
  let png;
  if (job.rig) {
    const rig = preset.rig;
    const cards = rig.cards.map((c) => ({ centre: c.centre_m, row: rig.row, normal: rig.normal, side: rig.side_m, reflectance: c.reflectance }));
    const { position_m, target_m, up, vertical_fov_deg } = rig.camera;
    png = (await picture(F, preset, cards, { position: position_m, target: target_m, up, fov: vertical_fov_deg }, job)).png;
  }
  const lux = [], rgb = [];
  for (const { point, normal } of job.probes) {
    const p = yUp(point), n = yUp(normal);
    const row = unit(cross(Math.abs(n[1]) > 0.9 ? [1, 0, 0] : [0, 1, 0], n));
    const up = cross(n, row);
    const { data } = await picture(F, preset, [{ centre: p, row, normal: n, side: 0.2, reflectance: kProbe }],
      { position: plus(p, n, 0.3), target: p, up, fov: 15 }, {});
    const mid = ((H / 2) * W + W / 2) * 4;
    let sum = [0, 0, 0];
    for (let y = -5; y < 5; ++y) for (let x = -5; x < 5; ++x) {
      const i = mid + 4 * (y * W + x);
      for (let c = 0; c < 3; ++c) sum[c] += decode(data[i + c] / 255) / 100;
    }
    const pixel = 0.212639 * sum[0] + 0.715169 * sum[1] + 0.072192 * sum[2];
    rgb.push(sum);
    lux.push(Math.PI * pixel / kProbe / preset.exposure.exposure);
  }
  return { lux, rgb, png };
}
