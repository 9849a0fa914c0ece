// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/rig_file.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/uncertain.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/compare_colors.h"
#include "lightcal/presets/learnt_engine.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

using records::Node;

// Looks things up and remembers the first that is not there.
class Finder {
 public:
  double Number(const Node& from, const char* key) {
    const Node& node = Part(from, key);
    if (!node.IsNumber()) Missing(key);
    return node.number;
  }
  std::string Text(const Node& from, const char* key) {
    const Node& node = Part(from, key);
    if (node.kind != Node::Kind::kText) Missing(key);
    return node.text;
  }
  Vec3 Triple(const Node& from, const char* key) {
    const std::vector<Node>& items = Part(from, key).items;
    if (items.size() != 3 || !std::ranges::all_of(items, &Node::IsNumber)) {
      Missing(key);
      return {};
    }
    return {items[0].number, items[1].number, items[2].number};
  }
  const Node& Part(const Node& from, const char* key) {
    static const Node kNothing;
    const Node* node = from.Find(key);
    if (node == nullptr) Missing(key);
    return node == nullptr ? kNothing : *node;
  }
  [[nodiscard]] const std::string& missing() const { return missing_; }
  void Missing(const std::string& key) {
    if (missing_.empty()) missing_ = key;
  }

 private:
  std::string missing_;
};

CheckedCard CardFrom(Finder& find, const Node& rig, const Node& json) {
  CheckedCard card;
  card.name = find.Text(json, "name");
  card.reflectance = find.Number(json, "reflectance");
  card.expected_lx = find.Number(json, "illuminance_lx");
  const Vec3 centre = find.Triple(json, "centre_m");
  const Vec3 row = find.Triple(rig, "row");
  const Vec3 across = Cross(find.Triple(rig, "normal"), row);
  const double reach = find.Number(rig, "side_m") / 4.0;
  const std::array<std::array<double, 2>, 4> kCorners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    card.inner_m[i] = centre + row * (reach * kCorners[i][0]) + across * (reach * kCorners[i][1]);
  }
  return card;
}

// {"value", "u95", "low95"?, "high95"?}; absent where it is none.
std::optional<Uncertain> UncertainIn(const Node& json, const char* key) {
  const Node* node = json.Find(key);
  const auto number = [&](const char* part) -> std::optional<double> {
    const Node* found = node == nullptr ? nullptr : node->Find(part);
    return found != nullptr && found->IsNumber() ? std::optional(found->number) : std::nullopt;
  };
  const auto value = number("value"), u95 = number("u95");
  if (!value || !u95) return std::nullopt;
  return Uncertain{*value, *u95, number("low95"), number("high95")};
}

CheckedLamp LampFrom(Finder& find, const Node& json) {
  CheckedLamp lamp;
  lamp.name = find.Text(json, "name");
  lamp.kind = find.Text(json, "kind");
  const Node& color = find.Part(json, "color");
  const Node& rgb = find.Part(color, "rec709_linear");
  lamp.color_u95_uv = ColorU95(UncertainIn(color, "cct_K"), UncertainIn(color, "duv"));
  lamp.color = find.Triple(rgb, "max_normalised");
  lamp.color_luminance = find.Number(rgb, "luminance_of_max_normalised");
  const Node& geometry = find.Part(json, "geometry");
  if (geometry.Find("outer_deg") != nullptr) lamp.outer_deg = find.Number(geometry, "outer_deg");
  if (geometry.Find("inner_deg") != nullptr) lamp.inner_deg = find.Number(geometry, "inner_deg");
  const auto length = [&](const char* key) -> std::optional<double> {
    const Node* node = geometry.Find(key);
    return node != nullptr && node->IsNumber() && node->number > 0.0 ? std::optional(node->number)
                                                                     : std::nullopt;
  };
  if (const auto kind = LightKindFromName(lamp.kind)) {
    lamp.surface_m2 = SurfaceOf(*kind, length("diameter_m"), length("width_m"), length("height_m"),
                                length("length_m"), length("radius_m"));
  }
  return lamp;
}

// As PipelineIn, of a rig, which is nothing without its white.
ColorTarget PipelineOf(Finder& find, const Node& lamp) {
  const Node* const linear = find.Part(lamp, "color").Find("pipeline_linear");
  if (linear == nullptr || linear->Find("space") == nullptr) return {};
  (void)find.Text(*linear, "space");
  (void)find.Part(*linear, "white_xy");
  return PipelineIn(lamp);
}

void FindCamera(Finder& find, const Node& json, CheckedRig& rig) {
  rig.camera_m = find.Triple(json, "position_m");
  rig.target_m = find.Triple(json, "target_m");
  rig.up = find.Triple(json, "up");
  rig.vertical_fov_rad = find.Number(json, "vertical_fov_deg") * kRadiansPerDegree;
}

void FindPlace(Finder& find, const Node& json, CheckedRig& rig) {
  if (json.Find("off_axis_deg") != nullptr) rig.off_axis_deg = find.Number(json, "off_axis_deg");
  if (json.Find("round_deg") != nullptr) rig.round_deg = find.Number(json, "round_deg");
  const Node* panorama = json.Find("panorama");
  if (panorama == nullptr) return;
  CheckedPanorama& seen = rig.panorama.emplace();
  seen.others_rgb_lx = find.Triple(*panorama, "others_rgb_lx");
  const Node& ways = find.Part(*panorama, "if_rgb_lx");
  const auto turns = MistakenTurns();
  for (std::size_t way = 0; way < kMistakenTurns; ++way) {
    const std::string word(turns[way].word);
    const Node& list = find.Part(ways, word.c_str());
    if (list.items.size() != kTurnSteps) {
      find.Missing(word);
      return;
    }
    for (std::size_t i = 0; i < kTurnSteps; ++i) {
      const std::vector<Node>& rgb = list.items[i].items;
      if (rgb.size() != 3 || !std::ranges::all_of(rgb, &Node::IsNumber)) {
        find.Missing(word);
        return;
      }
      seen.rgb_lx[way][i] = {rgb[0].number, rgb[1].number, rgb[2].number};
    }
  }
}

// Of several lamps, what each gives of the light on both cards.
void FindShares(const Node& cards, CheckedRig& rig) {
  const std::size_t count = rig.lamps.size();
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < cards.items.size(); ++i) {
    const Node* list = cards.items[i].Find("lights_lx");
    if (list == nullptr || list->items.size() != count) return;
    for (std::size_t k = 0; k < count; ++k) {
      if (!list->items[k].IsNumber() || !(list->items[k].number >= 0.0)) return;
      shares[k] += list->items[k].number / (2.0 * rig.cards[i].expected_lx);
    }
  }
  rig.lamp_shares = std::move(shares);
}

bool IsUsable(const CheckedRig& rig) {
  return rig.scale > 0.0 && rig.vertical_fov_rad > 0.0 && rig.vertical_fov_rad < 3.0 &&
         rig.cards[0].expected_lx > 0.0 && rig.cards[1].expected_lx > 0.0 &&
         rig.cards[0].reflectance > 0.0 && rig.cards[1].reflectance > 0.0;
}

}  // namespace

ColorTarget PipelineIn(const Node& light) {
  ColorTarget target;
  const Node* const color = light.Find("color");
  const Node* const pipeline = color == nullptr ? nullptr : color->Find("pipeline_linear");
  if (pipeline == nullptr) return target;
  if (const Node* const space = pipeline->Find("space")) {
    for (const RgbSpace known : kRgbSpaces) {
      if (RgbSpaceWord(known) == space->text) target.space = known;
    }
  }
  const Node* const white = pipeline->Find("white_xy");
  if (white != nullptr && white->items.size() == 2 && white->items[1].number > 0.0) {
    target.white = Xy{white->items[0].number, white->items[1].number};
  }
  return target;
}

Result<CheckedRig> RigFromPreset(const std::string& text, const std::string& path) {
  const auto root = records::ParseJson(text);
  if (!root || root->kind != Node::Kind::kTable) {
    return Refused("bad_rig", path, "is no JSON; give the <stem>.preset.json that export wrote");
  }
  if (root->Find("rig") == nullptr) {
    return Refused("no_rig", path, "has no rig: an older file; export it again with {preset.json}");
  }
  Finder find;
  CheckedRig rig;
  const Node& json = *root->Find("rig");
  rig.scale = find.Number(find.Part(*root, "exposure"), "exposure");
  rig.separation_m = find.Number(json, "separation_m");
  const Node& cards = find.Part(json, "cards");
  if (cards.items.size() == 2) {
    rig.cards = {CardFrom(find, json, cards.items[0]), CardFrom(find, json, cards.items[1])};
  } else {
    find.Missing("cards");
  }
  FindCamera(find, find.Part(json, "camera"), rig);
  FindPlace(find, json, rig);
  const std::string chosen = find.Text(json, "light");
  for (const Node& lamp : find.Part(*root, "lights").items) {
    rig.lamps.push_back(LampFrom(find, lamp));
    if (rig.lamps.back().name == chosen) rig.lamp = rig.lamps.size() - 1;
    // Panoramas' own figures are in the pipeline's colours, and so are their pictures.
    if (!rig.panorama) rig.pipeline = PipelineOf(find, lamp);
  }
  if (rig.lamps.empty()) find.Missing("lights");
  if (!find.missing().empty()) {
    return Refused(
        "bad_rig", path,
        "has no usable \"" + find.missing() + "\"; give the <stem>.preset.json that export wrote");
  }
  if (!IsUsable(rig)) return Refused("bad_rig", path, "its rig has numbers that cannot be");
  FindShares(cards, rig);
  return rig;
}

}  // namespace lightcal
