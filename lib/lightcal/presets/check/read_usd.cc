// SPDX-License-Identifier: Apache-2.0
// UsdLux in a .usda, one attribute a line, by the schema's own words: luminance = intensity
// 2^exposure colour nits, over the area where normalize is on; matrices of row vectors. Lights
// below untransformed parents. Of variants those that the file opens with.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/whole_text.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

struct Prim {
  std::string type, name;
  std::string space{};                          // of its colours: "acescg"; "" = Rec. 709
  std::map<std::string, std::string> values{};  // "inputs:radius" -> "0.5"; metadata, too

  [[nodiscard]] const std::string& Text(const std::string& key) const {
    static const std::string kNothing;
    const auto it = values.find(key);
    return it == values.end() ? kNothing : it->second;
  }
  [[nodiscard]] double Number(const std::string& key, double by_default) const {
    const std::string& text = Text(key);
    if (text.empty()) return by_default;
    if (text == "true" || text == "false") return text == "true" ? 1.0 : 0.0;
    const auto numbers = NumbersIn(text);
    if (numbers.size() != 1) throw std::runtime_error(name + ": " + key + " is no number");
    return numbers.front();
  }
  [[nodiscard]] bool On(const std::string& key) const { return Number(key, 0.0) != 0.0; }
};

std::string Unquoted(std::string_view text) {
  std::string out;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\') ++i;
    out += text[i];
  }
  return out;
}

std::string_view BetweenQuotes(std::string_view line) {
  const std::size_t quote = std::min(line.find('"'), line.size());
  const std::size_t close = std::min(line.find('"', quote + 1), line.size());
  return quote < close ? line.substr(quote + 1, close - quote - 1) : std::string_view();
}

// The variant sets of a file, line by line: which lines are of a variant that is not chosen.
class Variants {
 public:
  // Of a line that is another variant's, or begins or ends one.
  bool Takes(std::string_view line, const std::string& chosen) {
    const int before = depth_;
    if (line.ends_with("{")) ++depth_;
    if (line == "}") --depth_;
    if (line.starts_with("variantSet ")) {
      set_ = before;
      return true;
    }
    if (set_ < 0) return false;
    if (depth_ <= set_) set_ = -1;  // the set's own brace
    if (before == set_ + 1 && line.starts_with('"')) {
      other_ = BetweenQuotes(line) != chosen;
      return true;
    }
    return set_ < 0 || other_;
  }

 private:
  int depth_ = 0, set_ = -1;
  bool other_ = false;
};

// Nothing but opinions on lights of a person's stage.
bool AreOversAlone(const std::vector<Prim>& prims) {
  return std::ranges::all_of(prims, [](const Prim& prim) { return prim.type.empty(); });
}

// `def Type "name"` begins a prim; what follows is its own until the next one does. `over "name"`
// goes on with one that was there; a layer of nothing else is about prims of a person's stage.
std::vector<Prim> PrimsOf(const std::string& text) {
  if (!text.starts_with("#usda")) throw std::runtime_error("it does not begin with #usda");
  RequireClosed(text, kUsdaSyntax);
  std::vector<Prim> prims(1);  // the layer's own metadata
  std::size_t current = 0;
  Variants variants;
  std::string chosen;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = TrimBlanks(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (variants.Takes(line, chosen)) continue;
    if (line.starts_with("def ")) {
      const std::size_t quote = std::min(line.find('"'), line.size());
      Prim prim;
      prim.type = TrimBlanks(line.substr(4, quote - std::min<std::size_t>(quote, 4)));
      prim.name = BetweenQuotes(line);
      current = prims.size();
      prims.push_back(std::move(prim));
      continue;
    }
    if (line.starts_with("over ")) {
      auto it = std::ranges::find(prims, BetweenQuotes(line), &Prim::name);
      if (it == prims.end()) {
        if (!AreOversAlone(prims)) {
          throw std::runtime_error(std::string(line) + ": there is no such prim");
        }
        it = prims.insert(it, Prim{.type = {}, .name = std::string(BetweenQuotes(line))});
      }
      current = static_cast<std::size_t>(it - prims.begin());
      continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos) continue;
    const std::string_view left = line.substr(0, equals);
    const std::string_view value = TrimBlanks(line.substr(equals + 3));
    if (line.starts_with("string renderer = ")) chosen = BetweenQuotes(value);
    prims[current].values[std::string(left.substr(left.find_last_of(' ') + 1))] = value;
  }
  prims.front().values["renderer"] = chosen;
  return prims;
}

// 2^exposure, colour and intensity together.
double LuminanceOf(const Prim& prim) {
  if (prim.On("inputs:enableColorTemperature")) {
    throw std::runtime_error(prim.name + ": has a colour temperature on top of its colour");
  }
  const bool distant = prim.type == "DistantLight";
  double value = prim.Number("inputs:intensity", distant ? 50000.0 : 1.0) *
                 std::exp2(prim.Number("inputs:exposure", 0.0));
  if (const std::string& color = prim.Text("inputs:color"); !color.empty()) {
    const auto c = NumbersIn(color);
    if (c.size() != 3) throw std::runtime_error(prim.name + ": inputs:color has not three numbers");
    value *= LuminanceOfSpace(prim.space, {c[0], c[1], c[2]});
  }
  return value;
}

// Over the area where the light's power is normalised by it.
double UsdNits(const Prim& prim, double area_m2) {
  if (!prim.On("inputs:normalize")) return LuminanceOf(prim);
  return LuminanceOf(prim) / Above0(prim.name + ": its area", area_m2);
}

void Place(const Prim& prim, EngineLight& light) {
  const std::string& text = prim.Text("xformOp:transform");
  if (text.empty()) return;
  const auto m = NumbersIn(text);
  if (m.size() != 16) throw std::runtime_error(prim.name + ": a matrix without sixteen numbers");
  light.x = {m[0], m[1], m[2]};
  light.y = {m[4], m[5], m[6]};
  light.aim = {-m[8], -m[9], -m[10]};
  light.position_m = {m[12], m[13], m[14]};
}

void FromSphere(const Prim& prim, const FileText& beside, EngineLight& light) {
  const double r = prim.Number("inputs:radius", 0.5);
  light.emitted = UsdNits(prim, 4.0 * std::numbers::pi * r * r) * std::numbers::pi * r * r;
  if (const std::string& file = prim.Text("inputs:shaping:ies:file"); !file.empty()) {
    std::string name = file.substr(1, file.size() - std::min<std::size_t>(file.size(), 2));
    if (name.starts_with("./")) name.erase(0, 2);
    TakeTable(light, beside(name));
    return;
  }
  const double outer = prim.Number("inputs:shaping:cone:angle", 180.0);
  if (outer >= 180.0) return;
  light.kind = EngineLightKind::kSpot;
  light.law = ConeLaw::kSmoothInAngle;
  light.outer_rad = outer * kRadiansPerDegree;
  light.inner_rad = light.outer_rad * (1.0 - prim.Number("inputs:shaping:cone:softness", 0.0));
}

void FromDistant(const Prim& prim, const std::string& renderer, EngineLight& light) {
  light.kind = EngineLightKind::kSun;
  light.emitted = LuminanceOf(prim);
  if (renderer == "rtx_2024") {  // pi brighter than the schema's, whatever normalize says
    light.emitted *= std::numbers::pi;
    return;
  }
  if (prim.On("inputs:normalize")) return;
  const double sine = std::sin(prim.Number("inputs:angle", 0.53) * std::numbers::pi / 360.0);
  light.emitted *= std::numbers::pi * sine * sine;
}

EngineLight FromPrim(const Prim& prim, const std::string& renderer, const FileText& beside) {
  EngineLight light;
  light.name = prim.Text("displayName").empty() ? prim.name : Unquoted(prim.Text("displayName"));
  light.offset_m = prim.Number("distance_offset_m", 0.0);
  Place(prim, light);
  if (prim.type == "SphereLight") {
    FromSphere(prim, beside, light);
  } else if (prim.type == "DistantLight") {
    FromDistant(prim, renderer, light);
  } else if (prim.type == "DomeLight") {
    light.kind = EngineLightKind::kDome;
    light.emitted = LuminanceOf(prim);
  } else if (prim.type == "CylinderLight") {
    light.kind = EngineLightKind::kTube;
    light.width_m = prim.Number("inputs:length", 1.0);
    light.height_m = 2.0 * prim.Number("inputs:radius", 0.5);
    light.emitted = UsdNits(prim, std::numbers::pi * light.height_m * light.width_m);
  } else {
    light.kind = EngineLightKind::kFlat;
    light.round = prim.type == "DiskLight";
    const double diameter = 2.0 * prim.Number("inputs:radius", 0.5);
    light.width_m = light.round ? diameter : prim.Number("inputs:width", 1.0);
    light.height_m = light.round ? diameter : prim.Number("inputs:height", 1.0);
    light.emitted = UsdNits(
        prim, light.width_m * light.height_m * (light.round ? std::numbers::pi / 4.0 : 1.0));
  }
  return light;
}

}  // namespace

std::vector<EngineLight> ReadUsd(const std::string& text, const FileText& beside) {
  constexpr std::string_view kTypes[] = {"SphereLight", "DistantLight",  "DomeLight",
                                         "RectLight",   "CylinderLight", "DiskLight"};
  std::vector<Prim> prims = PrimsOf(text);
  if (prims.size() > 1 && AreOversAlone(prims)) return {};
  const std::string space = Unquoted(prims.front().Text("colorSpace"));
  if (prims.front().Number("metersPerUnit", 0.01) != 1.0 ||
      prims.front().Text("upAxis") != "\"Z\"") {
    throw std::runtime_error("it is not in metres with Z up, as lightcal writes");
  }
  std::vector<EngineLight> lights;
  for (Prim& prim : prims) {
    prim.space = space;
    if (std::ranges::find(kTypes, prim.type) != std::end(kTypes)) {
      lights.push_back(FromPrim(prim, prims.front().Text("renderer"), beside));
    }
  }
  return lights;
}

}  // namespace lightcal
