// SPDX-License-Identifier: Apache-2.0
// What the readers of presets in JSON share. Json is nlohmann::json, which only .cc files may name;
// all throw its exceptions.
#pragma once

#include <vector>

#include "lightcal/presets/check/reader_parts.h"

namespace lightcal {

template <class Json>
[[nodiscard]] Vec3 VecFrom(const Json& three) {
  return {three.at(0).template get<double>(), three.at(1).template get<double>(),
          three.at(2).template get<double>()};
}

// The value of "distance_offset_m"; 0 where there is none.
template <class Json>
[[nodiscard]] double OffsetIn(const Json& extras) {
  if (!extras.is_object() || !extras.contains("distance_offset_m")) return 0.0;
  return extras.at("distance_offset_m").at("value").template get<double>();
}

// Every one of "lights".
template <class Json>
[[nodiscard]] std::vector<EngineLight> EachLight(const Json& root,
                                                 EngineLight (*read)(const Json&)) {
  std::vector<EngineLight> lights;
  for (const Json& json : root.at("lights")) lights.push_back(read(json));
  return lights;
}

}  // namespace lightcal
