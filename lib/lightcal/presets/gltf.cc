// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 with KHR_lights_punctual; EXT_lights_ies and EXT_lights_image_based in further scenes.
// Intensities are cd and lx divided by the luminance of the max-normalised colour (the extension's
// colour is a multiplier in [0,1]); every light has a range, because Filament takes 10 m where none
// is given. Sources: Khronos glTF 2.0; KHR_lights_punctual; EXT_lights_ies; KHR_materials_specular
// (the cards are matt).
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "lightcal/core/base64.h"
#include "lightcal/light/lamp_axes.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/gltf_cube_maps.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/one_color_png.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/rig.h"

namespace lightcal {
namespace {

using records::Node;

constexpr double kNear_m = 0.01;
constexpr int kCubeSide = 32;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;

struct GltfScene {
  std::string name;
  std::vector<std::size_t> nodes;
  Node extensions = Node::Table();
};

// What the file is made of; its parts refer to each other by their places in these lists.
struct Gltf {
  std::string generator;
  std::vector<std::string> extensions_used;
  Node extensions = Node::Table();
  std::vector<Node> nodes;
  Node meshes = Node::Table();  // accessors, bufferViews, buffers, materials, meshes
  Node cameras, images;
  std::vector<GltfScene> scenes;
  Node extras;  // of every scene

  [[nodiscard]] Node Document() const {
    const auto scene_node = [&](const GltfScene& scene) -> Node {
      return {{"name", scene.name},
              {"nodes", scene.nodes},
              {"extras", Node{{"lightcal", extras}}},
              {"extensions", Node::UnlessEmpty(scene.extensions)}};
    };
    Node root = {{"asset", Node{{"version", "2.0"}, {"generator", generator}}},
                 {"extensionsUsed", extensions_used},
                 {"extensions", extensions},
                 {"nodes", nodes}};
    root.Put(meshes);
    root.Put({{"cameras", cameras},
              {"scenes", Node::List(scenes, scene_node)},
              {"scene", 0},
              {"images", images}});
    return root;
  }
};

// [node, ...]
Node ListOf(std::vector<Node> nodes) { return Node(nodes); }

// ---- lights ----

Node LightDefinition(const GltfLight& light, const std::string& name) {
  Node spot;
  if (light.outer_cone_rad) {
    spot = {{"innerConeAngle", light.inner_cone_rad}, {"outerConeAngle", light.outer_cone_rad}};
  }
  return {{"name", name},
          {"type", light.type},
          {"color", NodeOf(light.color)},
          {"intensity", light.intensity},
          {"range", light.range_m},
          {"spot", std::move(spot)}};
}

// What a person who opens the file in an engine can still read off the light.
Node LightExtras(const FittedLight& lamp, const PunctualLight& light) {
  const std::optional<Xy>& xy = light.color.xy;
  return {{"kind", LightKindName(lamp.kind)},
          {"intensity_cd", NodeOf(lamp.intensity_cd)},
          {"illuminance_lx", NodeOf(lamp.illuminance_lx)},
          {"flux_lm", NodeOf(lamp.flux_lm)},
          {"luminance_nits", NodeOf(lamp.luminance_nits)},
          {"distance_offset_m", NodeOf(lamp.distance_offset_m)},
          {"reference_position_m", lamp.position_m ? NodeOf(*lamp.position_m) : Node()},
          {"cct_K", NodeOf(lamp.color.cct_K)},
          {"duv", NodeOf(lamp.color.duv)},
          {"xy", xy ? Node{xy->x, xy->y} : Node()},
          {"color_luminance", light.color.luminance},
          {"intensity_u95", light.intensity_u95},
          {"substituted", Node::UnlessEmpty(light.substitution)}};
}

Node GltfNode(const GltfLight& gltf, const FittedLight& lamp, const PunctualLight& light,
              std::size_t index) {
  return {{"name", light.name},
          {"translation", NodeOf(gltf.translation)},
          {"rotation", NodeOf(gltf.rotation)},
          {"extensions", Node{{"KHR_lights_punctual", Node{{"light", index}}}}},
          {"extras", Node{{"lightcal", LightExtras(lamp, light)}}}};
}

// ---- rig ----

template <class T>
void AppendLittleEndian(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// A square in the local XY plane that faces +Z: 4 positions, 4 normals, 6 indices.
struct SquareMesh {
  float half = 0.0F;
  std::string bytes;
};

SquareMesh MakeSquare(Metres side) {
  SquareMesh mesh;
  mesh.half = static_cast<float>(side.value() / 2.0);
  const float h = mesh.half;
  for (const float v : {-h, -h, 0.0F, h, -h, 0.0F, h, h, 0.0F, -h, h, 0.0F}) {
    AppendLittleEndian(mesh.bytes, v);
  }
  for (int vertex = 0; vertex < 4; ++vertex) {
    for (const float v : {0.0F, 0.0F, 1.0F}) AppendLittleEndian(mesh.bytes, v);
  }
  for (const int index : {0, 1, 2, 0, 2, 3}) {
    AppendLittleEndian(mesh.bytes, static_cast<std::uint16_t>(index));
  }
  return mesh;
}

void AddSquareBuffer(Gltf& gltf, const SquareMesh& mesh) {
  constexpr int kVectorBytes = 48;
  constexpr int kIndexBytes = 12;
  const auto h = static_cast<double>(mesh.half);
  const auto view = [](int offset, int length, int target) -> Node {
    return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}, {"target", target}};
  };
  const std::string uri = "data:application/octet-stream;base64," + Base64(mesh.bytes);
  gltf.meshes.Put(
      {{"accessors",
        ListOf({Node{{"bufferView", 0},
                     {"componentType", kFloat},
                     {"count", 4},
                     {"type", "VEC3"},
                     {"min", Node{-h, -h, 0.0}},
                     {"max", Node{h, h, 0.0}}},
                Node{{"bufferView", 1}, {"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}},
                Node{{"bufferView", 2},
                     {"componentType", kUnsignedShort},
                     {"count", 6},
                     {"type", "SCALAR"}}})},
       {"bufferViews",
        ListOf({view(0, kVectorBytes, kArrayBuffer), view(kVectorBytes, kVectorBytes, kArrayBuffer),
                view(2 * kVectorBytes, kIndexBytes, kElementArrayBuffer)})},
       {"buffers", ListOf({Node{{"byteLength", mesh.bytes.size()}, {"uri", uri}}})}});
}

Node MattMaterial(const RigCard& card) {
  const double rho = card.reflectance;
  return {{"name", card.name},
          {"pbrMetallicRoughness", Node{{"baseColorFactor", Node{rho, rho, rho, 1.0}},
                                        {"metallicFactor", 0.0},
                                        {"roughnessFactor", 1.0}}},
          {"extensions", Node{{"KHR_materials_specular", Node{{"specularFactor", 0.0}}}}}};
}

Node CardMesh(const RigCard& card, std::size_t material) {
  return {{"name", card.name},
          {"primitives", ListOf({Node{{"attributes", Node{{"POSITION", 0}, {"NORMAL", 1}}},
                                      {"indices", 2},
                                      {"material", material}}})}};
}

Node CardNode(const RigCard& card, const Quaternion& rotation, std::size_t mesh) {
  return {{"name", card.name},
          {"mesh", mesh},
          {"translation", NodeOf(GltfFromZUp(card.centre_m))},
          {"rotation", NodeOf(rotation)},
          {"extras", Node{{"lightcal", Node{{"reflectance", card.reflectance},
                                            {"illuminance_lx", card.illuminance},
                                            {"luminance_nits", card.luminance}}}}}};
}

void AddCards(Gltf& gltf, const Rig& rig) {
  AddSquareBuffer(gltf, MakeSquare(rig.side));
  const Vec3 x = GltfFromZUp(rig.row);
  const Vec3 z = GltfFromZUp(rig.normal);
  const Quaternion rotation = RotationFromAxes(x, Cross(z, x), z);
  std::vector<Node> meshes;
  for (std::size_t i = 0; i < rig.cards.size(); ++i) {
    meshes.push_back(CardMesh(rig.cards[i], i));
    gltf.nodes.push_back(CardNode(rig.cards[i], rotation, i));
  }
  gltf.meshes.Put({{"materials", Node::List(rig.cards, MattMaterial)}, {"meshes", meshes}});
}

void AddCamera(Gltf& gltf, const RigCamera& camera) {
  const Vec3 from_target = GltfFromZUp(camera.position_m - camera.target_m);
  const Vec3 back = from_target * (1.0 / Length(from_target));
  const Vec3 up = GltfFromZUp(camera.up);
  gltf.cameras = ListOf({Node{{"name", "rig camera"},
                              {"type", "perspective"},
                              {"perspective", Node{{"aspectRatio", camera.aspect_ratio},
                                                   {"yfov", camera.vertical_fov},
                                                   {"znear", kNear_m},
                                                   {"zfar", kGltfRange_m}}}}});
  gltf.nodes.push_back({{"name", "rig camera"},
                        {"camera", 0},
                        {"translation", NodeOf(GltfFromZUp(camera.position_m))},
                        {"rotation", NodeOf(RotationFromAxes(Cross(up, back), up, back))}});
}

Node SceneExtras(const LightFile& file, const Rig& rig) {
  return {{"exposure", NodeOf(rig.exposure)},
          {"cards_at", Node{{"light", rig.light},
                            {"distance_m", rig.distance},
                            {"from_reading", rig.from_reading}}},
          {"provenance", NodeOf(file.provenance)}};
}

// ---- photometric files ----

// A second scene, "NAME (IES)", in which lamps with a table are EXT_lights_ies nodes instead of the
// spots and points of the first: a loader that knows both extensions must not light them twice. The
// file's candela are absolute, so the multiplier is 1/Y of the colour. C0 is the node's +X.
void AddPhotometricScene(Gltf& gltf, const LightFile& file,
                         const std::vector<PunctualLight>& lights,
                         const std::vector<std::optional<PresetFile>>& ies) {
  std::vector<Node> profiles;
  GltfScene scene = gltf.scenes.front();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!file.lights[i].distribution || !ies[i]) continue;
    const PunctualLight& light = lights[i];
    const LampAxes axes = AxesOfAim(light.aim, file.lights[i].axis.value_or(Vec3{}));
    scene.nodes[i] = gltf.nodes.size();
    const Node named = {{"light", profiles.size()},
                        {"multiplier", 1.0 / light.color.luminance},
                        {"color", NodeOf(light.color.max_normalised)}};
    gltf.nodes.push_back(
        {{"name", light.name + " (IES)"},
         {"translation", NodeOf(GltfFromZUp(light.position_m))},
         {"rotation", NodeOf(RotationFromAxes(GltfFromZUp(axes.c0), GltfFromZUp(axes.c90),
                                              GltfFromZUp(axes.aim * -1.0)))},
         {"extensions", Node{{"EXT_lights_ies", named}}}});
    profiles.push_back({{"name", light.name}, {"uri", preset_text::UriOf(ies[i]->name)}});
  }
  if (profiles.empty()) return;
  gltf.extensions_used.emplace_back("EXT_lights_ies");
  gltf.extensions.Put("EXT_lights_ies", {{"lights", profiles}});
  scene.name += " (IES)";
  gltf.scenes.push_back(std::move(scene));
}

// ---- domes ----

// A last scene, "NAME (image based)", in which the first dome is EXT_lights_image_based
// instead of the directional light of the others. Its irradiance, pi L in lux times the colour over
// Y, is the one coefficient of a constant, over Y00; the mirror images are L in nits, clipped at
// 255. The intensity stays 1: Babylon.js multiplies the coefficients by it twice.
void AddImageBasedScene(Gltf& gltf, const LightFile& file, const std::vector<PunctualLight>& lights,
                        const PresetOptions& options) {
  constexpr int kFaces = 6;
  constexpr int kSide = 4;
  constexpr int kCoefficients = 9;
  const auto dome = std::ranges::find(file.lights, LightKind::kDome, &FittedLight::kind);
  if (dome == file.lights.end()) return;
  const auto index = static_cast<std::size_t>(dome - file.lights.begin());
  const PunctualLight& light = lights[index];
  const Rgb& c = light.color.max_normalised;
  std::array<double, 3> radiance = {c.r, c.g, c.b};
  std::vector<std::array<double, 3>> coefficients(kCoefficients);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    radiance[i] *= light.intensity / std::numbers::pi;
    coefficients[0][i] = std::numbers::pi * radiance[i] * std::sqrt(4.0 * std::numbers::pi);
  }
  const auto picture = index < options.environments.size() && options.written == Written::kAll
                           ? options.environments[index]
                           : nullptr;
  Node specular;
  if (picture) {
    const Harmonics harmonics = RadianceHarmonics(*picture, &GltfFromZUp);
    // The extension names no basis. Babylon.js, its one reader, has Condon and Shortley's signs and
    // looks a right-handed scene up with z the other way round (rendered).
    constexpr std::array kSigns = {1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    for (std::size_t i = 0; i < harmonics.size(); ++i) {
      const double band = i == 0 ? 1.0 : i < 4 ? 2.0 / 3.0 : 0.25;
      for (std::size_t k = 0; k < 3; ++k) {
        coefficients[i][k] = kSigns[i] * std::numbers::pi * band * harmonics[i][k];
      }
    }
    gltf.images = Node::Array();
    specular = Node::Array();
    for (const CubeMap& mip : PrefilteredCube(*picture, kCubeSide)) {
      Node faces = Node::Array();
      for (const std::string& png : mip) {
        faces.items.emplace_back(gltf.images.items.size());
        gltf.images.items.push_back({{"uri", "data:image/png;base64," + Base64(png)}});
      }
      specular.items.push_back(std::move(faces));
    }
  } else {
    const std::string uri =
        "data:image/png;base64," + Base64(PngOfOneColor(kSide, RgbdOf(radiance)));
    gltf.images = ListOf({Node{{"name", light.name}, {"uri", uri}}});
    specular = ListOf({Node(std::vector<int>(kFaces, 0))});
  }
  gltf.extensions_used.emplace_back("EXT_lights_image_based");
  gltf.extensions.Put(
      "EXT_lights_image_based",
      {{"lights", ListOf({Node{{"name", light.name},
                               {"intensity", 1.0},
                               {"irradianceCoefficients", coefficients},
                               {"specularImages", std::move(specular)},
                               {"specularImageSize", picture ? kCubeSide : kSide}}})}});
  GltfScene scene = gltf.scenes.back();
  scene.name += " (image based)";
  std::erase(scene.nodes, index);
  scene.extensions.Put("EXT_lights_image_based", {{"light", 0}});
  gltf.scenes.push_back(std::move(scene));
}

Gltf WithLights(const LightFile& file, const std::string& stem,
                const std::vector<PunctualLight>& lights, const std::vector<FalloffRefit>& refits,
                const PresetOptions& options) {
  const Rig rig = BuildRig(file, lights, options.rig_place);
  Gltf gltf;
  gltf.generator = preset_text::GeneratorOf(file);
  gltf.extensions_used = {"KHR_lights_punctual"};
  if (options.rig) gltf.extensions_used.emplace_back("KHR_materials_specular");
  std::vector<Node> definitions;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const GltfLight light = GltfLightFrom(lights[i], refits[i]);
    definitions.push_back(LightDefinition(light, lights[i].name));
    gltf.nodes.push_back(GltfNode(light, file.lights[i], lights[i], i));
  }
  gltf.extensions.Put("KHR_lights_punctual", {{"lights", definitions}});
  if (options.rig) {
    AddCards(gltf, rig);
    AddCamera(gltf, rig.camera);
  }
  GltfScene all{preset_text::SceneStem(stem, options), std::vector<std::size_t>(gltf.nodes.size()),
                Node::Table()};
  std::iota(all.nodes.begin(), all.nodes.end(), std::size_t{0});
  gltf.scenes.push_back(std::move(all));
  gltf.extras = SceneExtras(file, rig);
  return gltf;
}

}  // namespace

Result<Preset> ExportGltf(const LightFile& lights, const std::string& stem,
                          const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "gltf", preset.warnings);
  const auto punctual = PunctualLightsFrom(lights, preset.warnings, options.color);
  if (!punctual) return tl::unexpected(punctual.error());
  auto ies = IesFiles(lights, stem, [&](std::size_t i) {
    return options.written != Written::kFigures && lights.lights[i].distribution.has_value();
  });
  if (!ies) return Propagate(std::move(ies));
  const auto refits = RefitInGltf(lights, *punctual, options, preset.warnings);
  Gltf gltf = WithLights(lights, stem, *punctual, refits, options);
  AddPhotometricScene(gltf, lights, *punctual, *ies);
  AddImageBasedScene(gltf, lights, *punctual, options);
  const std::string name = preset_text::SceneStem(stem, options);
  auto text = JsonText(gltf.Document(), name + ".gltf", options.written);
  if (!text) return Propagate(std::move(text));
  preset.files.push_back({name + ".gltf", std::move(*text)});
  for (std::size_t i = 0; i < punctual->size(); ++i) {
    preset.derived.push_back(DerivedGltf((*punctual)[i], refits[i]));
  }
  for (std::size_t i = 0; i < ies->size(); ++i) {
    if (lights.lights[i].distribution && (*ies)[i]) preset.files.push_back(*(*ies)[i]);
  }
  return preset;
}

}  // namespace lightcal
