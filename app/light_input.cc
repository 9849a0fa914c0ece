// SPDX-License-Identifier: Apache-2.0
#include "light_input.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "lightcal/presets/json_pieces.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/records/session_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::string_view kPresetSchema = "lightcal.preset/1";

// at() throws where a key is missing or of another type; the caller turns that into an error.
std::optional<Uncertain> UncertainAt(const Json& json, const char* key) {
  if (!json.contains(key)) return std::nullopt;
  const Json& u = json[key];
  Uncertain out{u.at("value").get<double>(), u.at("u95").get<double>(), {}, {}};
  if (u.contains("low95")) out.low = u["low95"].get<double>();
  if (u.contains("high95")) out.high = u["high95"].get<double>();
  return out;
}

std::optional<double> NumberAt(const Json& json, const char* key) {
  return json.contains(key) ? std::optional(json[key].get<double>()) : std::nullopt;
}

std::optional<Vec3> VectorAt(const Json& json, const char* key) {
  if (!json.contains(key)) return std::nullopt;
  return json[key].get<std::array<double, 3>>();
}

FittedLight LightOfPreset(const Json& json) {
  FittedLight light;
  light.name = json.at("name").get<std::string>();
  const auto kind = LightKindFromName(json.at("kind").get<std::string>());
  if (!kind) throw std::invalid_argument("\"kind\" is no kind of light");
  light.kind = *kind;
  const Json& photometry = json.at("photometry");
  light.intensity_cd = UncertainAt(photometry, "intensity_cd");
  light.flux_lm = UncertainAt(photometry, "flux_lm");
  light.illuminance_lx = UncertainAt(photometry, "illuminance_lx");
  light.luminance_nits = UncertainAt(photometry, "luminance_nits");
  light.distance_offset_m = UncertainAt(photometry, "distance_offset_m");
  const Json& color = json.at("color");
  light.color.cct_K = UncertainAt(color, "cct_K");
  light.color.duv = UncertainAt(color, "duv");
  if (color.contains("xy")) {
    const auto xy = color["xy"].get<std::array<double, 2>>();
    light.color.xy = Xy{xy[0], xy[1]};
  }
  const Json& geometry = json.at("geometry");
  light.position_m = VectorAt(geometry, "position_m");
  light.aim = VectorAt(geometry, "aim");
  light.axis = VectorAt(geometry, "axis");
  light.inner_deg = NumberAt(geometry, "inner_deg");
  light.outer_deg = NumberAt(geometry, "outer_deg");
  light.diameter_m = NumberAt(geometry, "diameter_m");
  light.width_m = NumberAt(geometry, "width_m");
  light.height_m = NumberAt(geometry, "height_m");
  light.length_m = NumberAt(geometry, "length_m");
  light.radius_m = NumberAt(geometry, "radius_m");
  return light;
}

Provenance ProvenanceIn(const Json& json) {
  Provenance provenance;
  provenance.generator = json.value("generator", "");
  provenance.time = json.value("time", "");
  provenance.devices = json.value("devices", std::vector<std::string>());
  provenance.inputs = json_pieces::FilesAt(json, "inputs");
  return provenance;
}

Result<LightFile> LightsOfPresetText(const Json& json, const std::string& path) {
  try {
    LightFile file;
    for (const Json& light : json.at("lights")) file.lights.push_back(LightOfPreset(light));
    file.provenance = ProvenanceIn(json.value("provenance", Json::object()));
    return file;
  } catch (const std::exception& error) {
    return Refused("bad_preset", path,
                   std::string("is not as lightcal writes it: ") + error.what() +
                       "; export it again with --to json");
  }
}

// Where the lights of a directory or a session's .toml lie.
Result<std::string> LightFileBelow(const std::string& path) {
  const fs::path directory = fs::path(JournalPath(path)).parent_path();
  for (const fs::path& candidate : {directory / "out" / "light.json", directory / "light.json"}) {
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) return candidate.string();
  }
  return Refused("no_light_file", path,
                 "holds no light.json, nor does its out; fit it first: lightcal run " + path);
}

}  // namespace

Result<LightFile> LightsIn(const std::string& path) {
  std::error_code error;
  std::string file = path;
  if (fs::is_directory(path, error) || fs::path(path).extension() == ".toml") {
    auto found = LightFileBelow(path);
    if (!found) return Propagate(std::move(found));
    file = *std::move(found);
  }
  const auto text = ReadWholeFile(file);
  if (!text) return tl::unexpected(text.error());
  const Json json = Json::parse(*text, nullptr, false);
  const bool preset =
      json.is_object() && json.contains("schema") && json["schema"] == kPresetSchema;
  return preset ? LightsOfPresetText(json, file) : LightFileFromJson(*text, file);
}

}  // namespace lightcal::app
