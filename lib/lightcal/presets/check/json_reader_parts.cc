// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/json_reader_parts.h"

#include <nlohmann/json.hpp>

namespace lightcal {

using Json = nlohmann::json;

Vec3 VecFrom(const Json& three) {
  return {three.at(0).get<double>(), three.at(1).get<double>(), three.at(2).get<double>()};
}

double LuminanceFrom(const Json& rgb) { return Rec709Luminance(VecFrom(rgb)); }

double OffsetIn(const Json& extras) {
  if (!extras.is_object() || !extras.contains("distance_offset_m")) return 0.0;
  return extras.at("distance_offset_m").at("value").get<double>();
}

std::string ObjectFrom(const std::string& text, std::size_t from) {
  const std::size_t start = text.find('{', from);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == '{') ++depth;
    if (c == '}' && --depth == 0) return text.substr(start, i - start + 1);
  }
  return {};
}

std::vector<EngineLight> EachLight(const Json& root, EngineLight (*read)(const Json&)) {
  std::vector<EngineLight> lights;
  for (const Json& json : root.at("lights")) lights.push_back(read(json));
  return lights;
}

}  // namespace lightcal
