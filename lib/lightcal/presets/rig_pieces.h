// SPDX-License-Identifier: Apache-2.0
// The rig as JSON, in the session's frame: what preset.json lists and what scripts build.
#pragma once

#include <vector>

#include "lightcal/presets/derived_light.h"
#include "lightcal/presets/json_pieces.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/rig.h"

namespace lightcal::json_pieces {

template <class Json>
[[nodiscard]] Json CardJson(const RigCard& card) {
  return {{"name", card.name},
          {"reflectance", card.reflectance},
          {"centre_m", Array<Json>(card.centre_m)},
          {"illuminance_lx", card.illuminance.value()},
          {"luminance_nits", card.luminance.value()}};
}

template <class Json>
[[nodiscard]] Json RigJson(const Rig& rig) {
  Json json = {{"light", rig.light},
               {"distance_m", rig.distance.value()},
               {"separation_m", rig.separation.value()},
               {"from_reading", rig.from_reading},
               {"normal", Array<Json>(rig.normal)},
               {"row", Array<Json>(rig.row)},
               {"side_m", rig.side.value()}};
  json["cards"] = {CardJson<Json>(rig.cards[0]), CardJson<Json>(rig.cards[1])};
  json["camera"] = {{"position_m", Array<Json>(rig.camera.position_m)},
                    {"target_m", Array<Json>(rig.camera.target_m)},
                    {"up", Array<Json>(rig.camera.up)},
                    {"vertical_fov_deg", DegreesFromRadians(rig.camera.vertical_fov)},
                    {"aspect_ratio", rig.camera.aspect_ratio}};
  return json;
}

template <class Json>
[[nodiscard]] Json ExposureJson(const RigExposure& exposure) {
  return {{"ev100", exposure.ev100}, {"exposure", exposure.scale}};
}

// The rig in an engine's axes: every place and direction through `map`, which is linear.
template <class Map>
[[nodiscard]] Rig Turned(Rig rig, Map map) {
  for (RigCard& card : rig.cards) card.centre_m = map(card.centre_m);
  rig.normal = map(rig.normal);
  rig.row = map(rig.row);
  rig.camera.position_m = map(rig.camera.position_m);
  rig.camera.target_m = map(rig.camera.target_m);
  rig.camera.up = map(rig.camera.up);
  return rig;
}

// What a person who opens the file in an engine can still read of the measurement.
template <class Json>
[[nodiscard]] Json MeasuredJson(const FittedLight& lamp, const PresetLight& light) {
  Json json = {{"kind", LightKindName(lamp.kind)}};
  Put<Json>(json, "intensity_cd", lamp.intensity_cd);
  Put<Json>(json, "illuminance_lx", lamp.illuminance_lx);
  Put<Json>(json, "luminance_nits", lamp.luminance_nits);
  Put<Json>(json, "distance_offset_m", lamp.distance_offset_m);
  Put<Json>(json, "cct_K", lamp.color.cct_K);
  Put<Json>(json, "duv", lamp.color.duv);
  json["color_luminance"] = light.color().luminance;
  if (!light.substitution.empty()) json["substituted"] = light.substitution;
  return json;
}

// The numbers of an exported light, for audit.
template <class Json>
[[nodiscard]] DerivedLight DerivedFrom(const Json& light) {
  constexpr std::size_t kLongest = 4;
  DerivedLight derived;
  derived.type = light.at("type").template get<std::string>();
  for (const auto& [key, value] : light.items()) {
    if (value.is_number()) derived.Put(key, value.template get<double>());
    if (!value.is_array() || value.size() > kLongest || !value.front().is_number()) continue;
    derived.Put(key, value.template get<std::vector<double>>());
  }
  return derived;
}

}  // namespace lightcal::json_pieces
