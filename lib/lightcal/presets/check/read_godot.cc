// SPDX-License-Identifier: Apache-2.0
// Godot 4's .tscn with physical light units, by its class reference: sections of "key = value"
// lines, basis by rows, Y up. Keys that are absent have the engine's defaults, so that a scene
// saved by the editor reads as it renders.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/scene_frame.h"
#include "lightcal/presets/check/whole_text.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

constexpr std::string_view kGodotEndsWith = "; This scene ends with the line \"; end\".";
constexpr std::string_view kGodotEnd = "\n; end";

struct Section {
  std::string kind, type, name, parent;  // "node", "OmniLight3D", "key", "."
  std::map<std::string, std::string> values;

  [[nodiscard]] double Number(const std::string& key, double by_default) const {
    const auto it = values.find(key);
    if (it == values.end()) return by_default;
    return OneNumber(name + ": " + key, it->second);
  }
  [[nodiscard]] double Positive(const std::string& key, double by_default) const {
    return Above0(name + ": " + key, Number(key, by_default));
  }
};

// The text between the quotes that follow `word=`.
std::string Attribute(std::string_view line, const std::string& word) {
  const std::size_t start = line.find(" " + word + "=\"");
  if (start == std::string_view::npos) return {};
  std::string out;
  for (std::size_t i = start + word.size() + 3; i < line.size() && line[i] != '"'; ++i) {
    if (line[i] == '\\' && i + 1 < line.size()) ++i;
    out += line[i];
  }
  return out;
}

bool IsLight(const Section& section) {
  return section.kind == "node" &&
         (section.type == "OmniLight3D" || section.type == "SpotLight3D" ||
          section.type == "DirectionalLight3D");
}

// A scene has no end of its own: ours says in its head by which line it ends, or, of before it did,
// says of each light at its end what was measured. The editor, which writes whole files, drops our
// comments; of any other file the last line is whole.
void RequireLastLine(const std::string& text, const Section& last) {
  constexpr std::string_view kCloses = "\n]})\"";
  if (text.find(kGodotEndsWith) != std::string::npos) {
    if (text.find(kGodotEnd) == std::string::npos) ThrowCutOff("its last line, \"; end\",");
  } else if (text.find("\n; lightcal ") != std::string::npos && IsLight(last) &&
             !last.values.contains("metadata/lightcal")) {
    ThrowCutOff("what ends its light \"" + last.name + "\"");
  } else if (kCloses.find(text.back()) == std::string_view::npos) {
    ThrowCutOff("the end of its last line");
  }
}

std::vector<Section> SectionsOf(const std::string& text) {
  std::vector<Section> sections;
  std::string key;  // of a dictionary that is still open
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = TrimBlanks(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (!key.empty()) {
      sections.back().values[key] += std::string(line) + "\n";
      if (line == "}") key.clear();
    } else if (line.starts_with('[') && line.ends_with(']')) {
      const std::string_view kind = line.substr(1, line.find_first_of(" ]") - 1);
      sections.push_back({std::string(kind),
                          Attribute(line, "type"),
                          Attribute(line, "name"),
                          Attribute(line, "parent"),
                          {}});
    } else if (const std::size_t equals = line.find(" = ");
               equals != std::string_view::npos && !sections.empty() && line.front() != ';') {
      const std::string name(line.substr(0, equals));
      sections.back().values[name] = line.substr(equals + 3);
      if (line.ends_with('{')) key = name;
    }
  }
  if (sections.empty() || sections.front().kind != "gd_scene") {
    throw std::runtime_error("it has no [gd_scene]");
  }
  if (!key.empty()) ThrowCutOff("the } of " + key);
  RequireLastLine(text, sections.back());
  return sections;
}

Vec3 LinearColor(const Section& section, const char* key) {
  const auto it = section.values.find(key);
  if (it == section.values.end()) return {1.0, 1.0, 1.0};
  const auto c = NumbersOf(section.name + ": " + key, it->second, 4);
  return {SrgbDecoded(c[0]), SrgbDecoded(c[1]), SrgbDecoded(c[2])};
}

// What light_temperature does to a colour: the black body's, its largest component 1. Kim et al.,
// US 7024034: x and y as cubics, 1667 to 25000 K.
Vec3 TintOf(double kelvin) {
  const double t = 1000.0 / std::clamp(kelvin, 1667.0, 25000.0);
  const double x = kelvin < 4000.0 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                   : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  const double y =
      kelvin < 2222.0   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
      : kelvin < 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                        : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  const double big_x = x / y;
  const double big_z = (1.0 - x - y) / y;
  const Vec3 rgb = {3.2404542 * big_x - 1.5371385 - 0.4985314 * big_z,
                    -0.9692660 * big_x + 1.8760108 + 0.0415560 * big_z,
                    0.0556434 * big_x - 0.2040259 + 1.0572252 * big_z};
  const double largest = std::max({rgb[0], rgb[1], rgb[2]});
  return {std::max(0.0, rgb[0] / largest), std::max(0.0, rgb[1] / largest),
          std::max(0.0, rgb[2] / largest)};
}

// {"name": ..., "distance_offset_m": ...} as lightcal leaves it beside a light.
std::string InMetadata(const Section& node, const std::string& key) {
  const auto it = node.values.find("metadata/lightcal");
  if (it == node.values.end()) return {};
  const std::size_t start = it->second.find("\"" + key + "\": ");
  if (start == std::string::npos) return {};
  const std::size_t value = start + key.size() + 4;
  return it->second.substr(value, it->second.find('\n', value) - value);
}

SceneFrame FrameOf(const Section& node) {
  const auto it = node.values.find("transform");
  if (it == node.values.end()) return {};
  const auto t = NumbersOf(node.name + ": transform", it->second, 12);
  return {{t[0], t[3], t[6]}, {t[1], t[4], t[7]}, {t[2], t[5], t[8]}, {t[9], t[10], t[11]}};
}

bool IsSwitchedOff(const Section& node, const char* key, const char* off) {
  const auto it = node.values.find(key);
  return it != node.values.end() && it->second == off;
}

// Where a node is in the scene, and whether it or what it hangs below is hidden there.
struct PlacedNode {
  SceneFrame frame;
  bool hidden = false;
};

// Parents come before their children, who name them by their path below the root.
class SceneTree {
 public:
  PlacedNode Place(const Section& node) {
    PlacedNode placed;
    const auto parent = placed_.find(node.parent);
    if (parent != placed_.end()) placed = parent->second;
    placed.frame = Within(placed.frame, FrameOf(node));
    placed.hidden = placed.hidden || IsSwitchedOff(node, "visible", "false") ||
                    IsSwitchedOff(node, "editor_only", "true");
    const std::string path = node.parent.empty()  ? "."
                             : node.parent == "." ? node.name
                                                  : node.parent + "/" + node.name;
    placed_[path] = placed;
    return placed;
  }

 private:
  std::map<std::string, PlacedNode> placed_;
};

EngineLight FromNode(const Section& node, const SceneFrame& frame) {
  EngineLight light;
  light.name = node.name;
  if (const std::string name = InMetadata(node, "name"); name.size() > 2) {
    light.name = Attribute(" name=" + name, "name");
  }
  if (const auto offset = NumbersIn(InMetadata(node, "distance_offset_m")); !offset.empty()) {
    light.offset_m = offset.front();
  }
  light.position_m = FromYUp(frame.origin);
  light.aim = FromYUp(UnitAlong(light.name, frame.z)) * -1.0;
  const Vec3 color = LinearColor(node, "light_color");
  const Vec3 tint = TintOf(node.Number("light_temperature", 6500.0));
  light.rgb = Vec3{color[0] * tint[0], color[1] * tint[1], color[2] * tint[2]};
  const double scale = node.Number("light_energy", 1.0) * Rec709Luminance(*light.rgb) *
                       (IsSwitchedOff(node, "light_negative", "true") ? -1.0 : 1.0);
  if (node.type == "DirectionalLight3D") {
    light.kind = EngineLightKind::kSun;
    light.emitted = node.Number("light_intensity_lux", 100000.0) * scale;
    return light;
  }
  const double lumens = node.Number("light_intensity_lumens", 1000.0) * scale;
  if (node.type == "OmniLight3D") {
    light.emitted = lumens / (4.0 * std::numbers::pi);
    light.range_m = node.Number("omni_range", 5.0);
    light.decay = node.Number("omni_attenuation", 1.0);
    return light;
  }
  light.kind = EngineLightKind::kSpot;
  light.law = ConeLaw::kPower;
  light.emitted = lumens / std::numbers::pi;
  light.range_m = node.Number("spot_range", 5.0);
  light.decay = node.Number("spot_attenuation", 1.0);
  light.outer_rad = node.Number("spot_angle", 45.0) * kRadiansPerDegree;
  light.cone_power = 1.0 / node.Positive("spot_angle_attenuation", 1.0);
  return light;
}

// pixel = luminance * this, at the aperture, shutter and ISO of the camera; 0 = no camera.
double ExposureIn(const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    if (section.type != "CameraAttributesPhysical") continue;
    const double n = section.Number("exposure_aperture", 16.0);
    return section.Positive("exposure_sensitivity", 100.0) / 100.0 /
           section.Positive("exposure_shutter_speed", 100.0) /
           Above0(section.name + ": exposure_aperture", 1.2 * n * n);
  }
  return 0.0;
}

}  // namespace

std::vector<EngineLight> ReadGodot(const std::string& text, const FileText& /*beside*/) {
  std::vector<EngineLight> lights;
  const std::vector<Section> sections = SectionsOf(text);
  const double exposure = ExposureIn(sections);
  SceneTree tree;
  for (const Section& section : sections) {
    if (section.kind == "node") {
      const PlacedNode placed = tree.Place(section);
      if (IsLight(section) && !placed.hidden) lights.push_back(FromNode(section, placed.frame));
    }
    constexpr double kSky = 2.0;  // background_mode: what a picture lights is not in this text
    if (section.type == "Environment" && section.values.contains("background_intensity") &&
        section.Number("background_mode", 1.0) != kSky) {
      EngineLight dome;
      dome.kind = EngineLightKind::kDome;
      // Its light goes past intensity and exposure; without a camera the intensity says which.
      const double nits_per_unit =
          exposure > 0.0 ? 1.0 / exposure : section.Number("background_intensity", 30000.0);
      dome.emitted = section.Number("background_energy_multiplier", 1.0) * nits_per_unit *
                     Rec709Luminance(LinearColor(section, "background_color"));
      dome.rgb = LinearColor(section, "background_color");
      lights.push_back(dome);
    }
  }
  return lights;
}

}  // namespace lightcal
