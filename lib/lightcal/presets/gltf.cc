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
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "lightcal/core/base64.h"
#include "lightcal/light/lamp_axes.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/json_pieces.h"
#include "lightcal/presets/one_color_png.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/rig.h"

namespace lightcal {
namespace {

using Json = nlohmann::ordered_json;
using json_pieces::Array;
using json_pieces::Put;

constexpr double kNear_m = 0.01;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;

// ---- lights ----

Json LightDefinition(const GltfLight& light, const std::string& name) {
  Json json = {{"name", name},
               {"type", light.type},
               {"color", Array<Json>(light.color)},
               {"intensity", light.intensity}};
  Put<Json>(json, "range", light.range_m);
  if (light.outer_cone_rad) {
    json["spot"] = {{"innerConeAngle", *light.inner_cone_rad},
                    {"outerConeAngle", *light.outer_cone_rad}};
  }
  return json;
}

// What a person who opens the file in an engine can still read off the light.
Json LightExtras(const FittedLight& lamp, const PunctualLight& light) {
  Json json = {{"kind", LightKindName(lamp.kind)}};
  Put<Json>(json, "intensity_cd", lamp.intensity_cd);
  Put<Json>(json, "illuminance_lx", lamp.illuminance_lx);
  Put<Json>(json, "flux_lm", lamp.flux_lm);
  Put<Json>(json, "luminance_nits", lamp.luminance_nits);
  Put<Json>(json, "distance_offset_m", lamp.distance_offset_m);
  if (lamp.position_m) json["reference_position_m"] = Array<Json>(*lamp.position_m);
  Put<Json>(json, "cct_K", lamp.color.cct_K);
  Put<Json>(json, "duv", lamp.color.duv);
  if (light.color.xy) json["xy"] = {light.color.xy->x, light.color.xy->y};
  json["color_luminance"] = light.color.luminance;
  Put<Json>(json, "intensity_u95", light.intensity_u95);
  if (!light.substitution.empty()) json["substituted"] = light.substitution;
  return json;
}

Json LightNode(const GltfLight& gltf, const FittedLight& lamp, const PunctualLight& light,
               std::size_t index) {
  return {{"name", light.name},
          {"translation", Array<Json>(gltf.translation)},
          {"rotation", Array<Json>(gltf.rotation)},
          {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}},
          {"extras", {{"lightcal", LightExtras(lamp, light)}}}};
}

// The same for audit.
DerivedLight DerivedOf(const PunctualLight& light, const FalloffRefit& refit) {
  const GltfLight gltf = GltfLightFrom(light, refit);
  DerivedLight derived;
  derived.type = std::string(gltf.type);
  const auto put = [&](const char* name, const std::optional<double>& value) {
    if (value) derived.Put(name, *value);
  };
  const auto put_all = [&](const char* name, const auto& values) {
    std::vector<double> plain;
    for (const double v : values) plain.push_back(v == 0.0 ? 0.0 : v);  // -0 is written 0
    derived.Put(name, std::move(plain));
  };
  put("intensity", gltf.intensity);
  put("intensity_u95", gltf.intensity_u95);
  put_all("color", gltf.color);
  put("range", gltf.range_m);
  put("innerConeAngle", gltf.inner_cone_rad);
  put("outerConeAngle", gltf.outer_cone_rad);
  put_all("translation", gltf.translation);
  put_all("rotation", gltf.rotation);
  if (light.type != PunctualType::kDirectional) {
    derived.notes.push_back({"falloff_residual", {refit.residual}});
  }
  derived.substitution = light.substitution;
  return derived;
}

// A file's name as a relative URI.
std::string UriOf(const std::string& name) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    if (plain) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += {'%', kHex[byte >> 4U], kHex[byte & 15U]};
  }
  return uri;
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

void AddSquareBuffer(Json& root, const SquareMesh& mesh) {
  constexpr int kVectorBytes = 48;
  constexpr int kIndexBytes = 12;
  const auto h = static_cast<double>(mesh.half);
  root["accessors"] = {
      {{"bufferView", 0},
       {"componentType", kFloat},
       {"count", 4},
       {"type", "VEC3"},
       {"min", {-h, -h, 0.0}},
       {"max", {h, h, 0.0}}},
      {{"bufferView", 1}, {"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}},
      {{"bufferView", 2}, {"componentType", kUnsignedShort}, {"count", 6}, {"type", "SCALAR"}}};
  root["bufferViews"] = {
      {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", kVectorBytes}, {"target", kArrayBuffer}},
      {{"buffer", 0},
       {"byteOffset", kVectorBytes},
       {"byteLength", kVectorBytes},
       {"target", kArrayBuffer}},
      {{"buffer", 0},
       {"byteOffset", 2 * kVectorBytes},
       {"byteLength", kIndexBytes},
       {"target", kElementArrayBuffer}}};
  root["buffers"] = {{{"byteLength", mesh.bytes.size()},
                      {"uri", "data:application/octet-stream;base64," + Base64(mesh.bytes)}}};
}

Json MattMaterial(const RigCard& card) {
  const double rho = card.reflectance;
  return {{"name", card.name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {rho, rho, rho, 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", 1.0}}},
          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.0}}}}}};
}

Json CardNode(const RigCard& card, const Quaternion& rotation, std::size_t mesh) {
  return {{"name", card.name},
          {"mesh", mesh},
          {"translation", Array<Json>(GltfFromZUp(card.centre_m))},
          {"rotation", Array<Json>(rotation)},
          {"extras",
           {{"lightcal",
             {{"reflectance", card.reflectance},
              {"illuminance_lx", card.illuminance.value()},
              {"luminance_nits", card.luminance.value()}}}}}};
}

void AddCards(Json& root, const Rig& rig) {
  AddSquareBuffer(root, MakeSquare(rig.side));
  const Vec3 x = GltfFromZUp(rig.row);
  const Vec3 z = GltfFromZUp(rig.normal);
  const Quaternion rotation = RotationFromAxes(x, Cross(z, x), z);
  for (std::size_t i = 0; i < rig.cards.size(); ++i) {
    root["materials"].push_back(MattMaterial(rig.cards[i]));
    root["meshes"].push_back(
        {{"name", rig.cards[i].name},
         {"primitives",
          {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"material", i}}}}});
    root["nodes"].push_back(CardNode(rig.cards[i], rotation, i));
  }
}

void AddCamera(Json& root, const RigCamera& camera) {
  const Vec3 from_target = GltfFromZUp(camera.position_m - camera.target_m);
  const Vec3 back = from_target * (1.0 / Length(from_target));
  const Vec3 up = GltfFromZUp(camera.up);
  root["cameras"] = {{{"name", "rig camera"},
                      {"type", "perspective"},
                      {"perspective",
                       {{"aspectRatio", camera.aspect_ratio},
                        {"yfov", camera.vertical_fov.value()},
                        {"znear", kNear_m},
                        {"zfar", kGltfRange_m}}}}};
  root["nodes"].push_back({{"name", "rig camera"},
                           {"camera", 0},
                           {"translation", Array<Json>(GltfFromZUp(camera.position_m))},
                           {"rotation", Array<Json>(RotationFromAxes(Cross(up, back), up, back))}});
}

Json SceneExtras(const LightFile& file, const Rig& rig) {
  Json json = {{"exposure", {{"ev100", rig.exposure.ev100}, {"exposure", rig.exposure.scale}}},
               {"cards_at",
                {{"light", rig.light},
                 {"distance_m", rig.distance.value()},
                 {"from_reading", rig.from_reading}}}};
  json["provenance"] = json_pieces::ProvenanceJson<Json>(file.provenance);
  return json;
}

// ---- photometric files ----

// A second scene, "NAME (IES)", in which lamps with a table are EXT_lights_ies nodes instead of the
// spots and points of the first: a loader that knows both extensions must not light them twice. The
// file's candela are absolute, so the multiplier is 1/Y of the colour. C0 is the node's +X.
void AddPhotometricScene(Json& root, const LightFile& file,
                         const std::vector<PunctualLight>& lights,
                         const std::vector<std::optional<PresetFile>>& ies) {
  Json profiles = Json::array();
  Json nodes = root["scenes"][0]["nodes"];
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!file.lights[i].distribution || !ies[i]) continue;
    const PunctualLight& light = lights[i];
    const LampAxes axes = AxesOfAim(light.aim);
    const Rgb& c = light.color.max_normalised;
    nodes[i] = root["nodes"].size();
    root["nodes"].push_back(
        {{"name", light.name + " (IES)"},
         {"translation", Array<Json>(GltfFromZUp(light.position_m))},
         {"rotation", Array<Json>(RotationFromAxes(GltfFromZUp(axes.c0), GltfFromZUp(axes.c90),
                                                   GltfFromZUp(axes.aim * -1.0)))},
         {"extensions",
          {{"EXT_lights_ies",
            {{"light", profiles.size()},
             {"multiplier", 1.0 / light.color.luminance},
             {"color", Array<Json>(std::array<double, 3>{c.r, c.g, c.b})}}}}}});
    profiles.push_back({{"name", light.name}, {"uri", UriOf(ies[i]->name)}});
  }
  if (profiles.empty()) return;
  root["extensionsUsed"].push_back("EXT_lights_ies");
  root["extensions"]["EXT_lights_ies"] = {{"lights", std::move(profiles)}};
  Json scene = root["scenes"][0];
  scene["name"] = std::string(scene["name"]) + " (IES)";
  scene["nodes"] = std::move(nodes);
  root["scenes"].push_back(std::move(scene));
}

// ---- domes ----

// A radiance as RGBD, whose value is rgb/d: at most 255 in the largest component.
std::array<std::uint8_t, 4> RgbdOf(const std::array<double, 3>& radiance) {
  constexpr double kTop = 255.0;
  const double largest = std::max({radiance[0], radiance[1], radiance[2], 1.0});
  const double d = std::clamp(std::floor(kTop / largest), 1.0, kTop) / kTop;
  const double clipped = std::min(1.0, 1.0 / (largest * d));
  std::array<std::uint8_t, 4> out{};
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    out[i] = static_cast<std::uint8_t>(std::lround(kTop * SrgbEncoded(radiance[i] * d * clipped)));
  }
  out[3] = static_cast<std::uint8_t>(std::lround(kTop * d));
  return out;
}

// A last scene, "NAME (image based)", in which the first even dome is EXT_lights_image_based
// instead of the directional light of the others. Its irradiance, pi L in lux times the colour over
// Y, is the one coefficient of a constant, over Y00; the mirror images are L in nits, clipped at
// 255. The intensity stays 1: Babylon.js multiplies the coefficients by it twice.
void AddImageBasedScene(Json& root, const LightFile& file,
                        const std::vector<PunctualLight>& lights) {
  constexpr double kPi = std::numbers::pi;
  constexpr int kFaces = 6;
  constexpr int kSide = 4;
  const auto dome = std::ranges::find(file.lights, LightKind::kDome, &FittedLight::kind);
  if (dome == file.lights.end()) return;
  const auto index = static_cast<std::size_t>(dome - file.lights.begin());
  const PunctualLight& light = lights[index];
  const Rgb& c = light.color.max_normalised;
  std::array<double, 3> radiance = {c.r, c.g, c.b};
  Json coefficients = Json::array();
  for (int k = 0; k < 9; ++k) coefficients.push_back({0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    radiance[i] *= light.intensity / kPi;
    coefficients[0][i] = kPi * radiance[i] * std::sqrt(4.0 * kPi);
  }
  root["images"] = {
      {{"name", light.name},
       {"uri", "data:image/png;base64," + Base64(PngOfOneColor(kSide, RgbdOf(radiance)))}}};
  root["extensionsUsed"].push_back("EXT_lights_image_based");
  root["extensions"]["EXT_lights_image_based"]["lights"] = {
      {{"name", light.name},
       {"intensity", 1.0},
       {"irradianceCoefficients", std::move(coefficients)},
       {"specularImages", Json::array({Json(std::vector<int>(kFaces, 0))})},
       {"specularImageSize", kSide}}};
  Json scene = root["scenes"].back();
  scene["name"] = std::string(scene["name"]) + " (image based)";
  Json nodes = Json::array();
  for (const Json& node : scene["nodes"]) {
    if (node != index) nodes.push_back(node);
  }
  scene["nodes"] = std::move(nodes);
  scene["extensions"]["EXT_lights_image_based"]["light"] = 0;
  root["scenes"].push_back(std::move(scene));
}

Json Document(const LightFile& file, const std::string& stem,
              const std::vector<PunctualLight>& lights, const std::vector<FalloffRefit>& refits,
              const PresetOptions& options) {
  const Rig rig = BuildRig(file, lights);
  const std::string generator =
      file.provenance.generator.empty() ? "lightcal" : file.provenance.generator;
  Json root = {{"asset", {{"version", "2.0"}, {"generator", generator}}}};
  root["extensionsUsed"] = {"KHR_lights_punctual"};
  if (!options.bare) root["extensionsUsed"].push_back("KHR_materials_specular");
  Json definitions = Json::array();
  Json nodes = Json::array();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const GltfLight gltf = GltfLightFrom(lights[i], refits[i]);
    definitions.push_back(LightDefinition(gltf, lights[i].name));
    nodes.push_back(LightNode(gltf, file.lights[i], lights[i], i));
  }
  root["extensions"] = {{"KHR_lights_punctual", {{"lights", std::move(definitions)}}}};
  root["nodes"] = std::move(nodes);
  if (!options.bare) {
    AddCards(root, rig);
    AddCamera(root, rig.camera);
  }
  Json all = Json::array();
  for (std::size_t i = 0; i < root["nodes"].size(); ++i) all.push_back(i);
  root["scenes"] = Json::array({{{"name", stem},
                                 {"nodes", std::move(all)},
                                 {"extras", {{"lightcal", SceneExtras(file, rig)}}}}});
  root["scene"] = 0;
  return root;
}

}  // namespace

Result<Preset> ExportGltf(const LightFile& lights, const std::string& stem,
                          const PresetOptions& options) {
  Preset preset;
  const auto punctual = PunctualLightsFrom(lights, preset.warnings, options.color);
  if (!punctual) return tl::unexpected(punctual.error());
  auto ies = IesFiles(lights, stem);
  if (!ies) return Propagate(std::move(ies));
  const auto refits = RefitInGltf(lights, *punctual, options, preset.warnings);
  Json document = Document(lights, stem, *punctual, refits, options);
  AddPhotometricScene(document, lights, *punctual, *ies);
  AddImageBasedScene(document, lights, *punctual);
  auto text = json_pieces::TextOf(document, stem + ".gltf");
  if (!text) return Propagate(std::move(text));
  preset.files.push_back({stem + ".gltf", std::move(*text)});
  for (std::size_t i = 0; i < punctual->size(); ++i) {
    preset.derived.push_back(DerivedOf((*punctual)[i], refits[i]));
  }
  for (std::size_t i = 0; i < ies->size(); ++i) {
    if (lights.lights[i].distribution && (*ies)[i]) preset.files.push_back(*(*ies)[i]);
  }
  return preset;
}

}  // namespace lightcal
