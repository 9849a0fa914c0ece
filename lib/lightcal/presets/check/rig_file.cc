// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/rig_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace lightcal {
namespace {

using Json = nlohmann::json;

// Looks things up and remembers the first that is not there.
class Finder {
 public:
  double Number(const Json& from, const char* key) {
    const auto it = from.is_object() ? from.find(key) : from.end();
    if (!from.is_object() || it == from.end() || !it->is_number()) return Missing(key), 0.0;
    return it->get<double>();
  }
  std::string Text(const Json& from, const char* key) {
    const auto it = from.is_object() ? from.find(key) : from.end();
    if (!from.is_object() || it == from.end() || !it->is_string()) return Missing(key), "";
    return it->get<std::string>();
  }
  std::array<double, 3> Triple(const Json& from, const char* key) {
    const auto it = from.is_object() ? from.find(key) : from.end();
    if (!from.is_object() || it == from.end() || !it->is_array() || it->size() != 3 ||
        !(*it)[0].is_number() || !(*it)[1].is_number() || !(*it)[2].is_number()) {
      return Missing(key), std::array<double, 3>{};
    }
    return {(*it)[0].get<double>(), (*it)[1].get<double>(), (*it)[2].get<double>()};
  }
  const Json& Part(const Json& from, const char* key) {
    static const Json kNothing;
    const auto it = from.is_object() ? from.find(key) : from.end();
    if (!from.is_object() || it == from.end()) return Missing(key), kNothing;
    return *it;
  }
  [[nodiscard]] const std::string& missing() const { return missing_; }
  void Missing(const std::string& key) {
    if (missing_.empty()) missing_ = key;
  }

 private:
  std::string missing_;
};

CheckedCard CardFrom(Finder& find, const Json& rig, const Json& json) {
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

CheckedLamp LampFrom(Finder& find, const Json& json) {
  CheckedLamp lamp;
  lamp.name = find.Text(json, "name");
  lamp.kind = find.Text(json, "kind");
  const Json& rgb = find.Part(find.Part(json, "color"), "rec709_linear");
  lamp.color = find.Triple(rgb, "max_normalised");
  lamp.color_luminance = find.Number(rgb, "luminance_of_max_normalised");
  const Json& geometry = find.Part(json, "geometry");
  if (geometry.is_object() && geometry.contains("outer_deg")) {
    lamp.outer_deg = find.Number(geometry, "outer_deg");
  }
  return lamp;
}

void FindCamera(Finder& find, const Json& json, CheckedRig& rig) {
  rig.camera_m = find.Triple(json, "position_m");
  rig.target_m = find.Triple(json, "target_m");
  rig.up = find.Triple(json, "up");
  rig.vertical_fov_rad = find.Number(json, "vertical_fov_deg") * std::numbers::pi / 180.0;
}

bool IsUsable(const CheckedRig& rig) {
  return rig.scale > 0.0 && rig.vertical_fov_rad > 0.0 && rig.vertical_fov_rad < 3.0 &&
         rig.cards[0].expected_lx > 0.0 && rig.cards[1].expected_lx > 0.0 &&
         rig.cards[0].reflectance > 0.0 && rig.cards[1].reflectance > 0.0;
}

}  // namespace

Result<CheckedRig> RigFromPreset(const std::string& text, const std::string& path) {
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object()) {
    return Refused("bad_rig", path, "is no JSON; give the <stem>.preset.json that export wrote");
  }
  if (!root.contains("rig")) {
    return Refused("no_rig", path, "has no rig; export it without --bare, with --to json");
  }
  Finder find;
  CheckedRig rig;
  const Json& json = root["rig"];
  rig.scale = find.Number(find.Part(root, "exposure"), "exposure");
  rig.separation_m = find.Number(json, "separation_m");
  const Json& cards = find.Part(json, "cards");
  if (cards.is_array() && cards.size() == 2) {
    rig.cards = {CardFrom(find, json, cards[0]), CardFrom(find, json, cards[1])};
  } else {
    find.Missing("cards");
  }
  FindCamera(find, find.Part(json, "camera"), rig);
  const std::string chosen = find.Text(json, "light");
  for (const Json& lamp : find.Part(root, "lights")) {
    rig.lamps.push_back(LampFrom(find, lamp));
    if (rig.lamps.back().name == chosen) rig.lamp = rig.lamps.size() - 1;
  }
  if (rig.lamps.empty()) find.Missing("lights");
  if (!find.missing().empty()) {
    return Refused(
        "bad_rig", path,
        "has no usable \"" + find.missing() + "\"; give the <stem>.preset.json that export wrote");
  }
  if (!IsUsable(rig)) return Refused("bad_rig", path, "its rig has numbers that cannot be");
  return rig;
}

}  // namespace lightcal
