// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/into_scene.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "lightcal/core/did_you_mean.h"

namespace lightcal {
namespace {

std::string NamesOfLamps(const LightFile& file) {
  std::vector<std::string_view> names;
  for (const FittedLight& lamp : file.lights) names.push_back(lamp.name);
  return Joined(names);
}

}  // namespace

Result<std::vector<IntoRow>> IntoByPattern(const LightFile& lights, const std::string& pattern) {
  if (lights.lights.size() > 1) {
    return Refused("into_many_lamps", pattern,
                   "would give the same lights " + std::to_string(lights.lights.size()) +
                       " lamps (" + NamesOfLamps(lights) +
                       "); say which gets which in a map.csv of lines lamp,object");
  }
  std::vector<IntoRow> rows;
  for (const FittedLight& lamp : lights.lights) rows.push_back({lamp.name, pattern});
  return rows;
}

Result<void> CheckInto(const LightFile& lights, std::span<const IntoRow> rows) {
  std::map<std::string, std::string> lamp_of;
  for (const IntoRow& row : rows) {
    if (row.lamp.empty() || row.object.empty()) {
      return Refused("into_map", row.lamp.empty() ? row.object : row.lamp,
                     "{preset.into} has a line without a lamp or without an object; write "
                     "lamp,object, such as key,PropLamp_*");
    }
    const auto lamp = std::ranges::find(lights.lights, row.lamp, &FittedLight::name);
    if (lamp == lights.lights.end()) {
      return Refused("into_unknown_lamp", row.lamp,
                     "is no lamp of these" + DidYouMean(row.lamp, lights.lights));
    }
    if (lamp->kind == LightKind::kDome) {
      return Refused("into_no_light", row.lamp,
                     "is light from all around, which no light of a scene is; leave it out and "
                     "export it without {preset.into}");
    }
    const auto [earlier, added] = lamp_of.emplace(row.object, row.lamp);
    if (!added && earlier->second != row.lamp) {
      return Refused("into_two_lamps", row.object,
                     "would get two lamps, " + earlier->second + " and " + row.lamp +
                         "; leave one of the two lines");
    }
  }
  return {};
}

IntoLights OnlyInto(const LightFile& lights, const PresetOptions& options) {
  IntoLights out{lights, options};
  out.lights.lights.clear();
  out.options.environments.clear();
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    if (std::ranges::find(options.into, lamp.name, &IntoRow::lamp) == options.into.end()) continue;
    out.lights.lights.push_back(lamp);
    if (i < options.environments.size()) {
      out.options.environments.push_back(options.environments[i]);
    }
  }
  return out;
}

records::Node IntoNode(std::span<const IntoRow> rows) {
  if (rows.empty()) return {};
  return records::Node::List(rows, [](const IntoRow& row) {
    return records::Node{{"lamp", row.lamp}, {"object", row.object}};
  });
}

}  // namespace lightcal
