// SPDX-License-Identifier: Apache-2.0
// A session of some of its lights.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "lightcal/records/session.h"

namespace lightcal {

// Whether a light is among those asked for: of `only` (empty: all) and not of `without`.
[[nodiscard]] inline bool IsAsked(const std::string& light, const std::vector<std::string>& only,
                                  const std::vector<std::string>& without) {
  const auto in = [&](const std::vector<std::string>& names) {
    return std::ranges::find(names, light) != names.end();
  };
  return !in(without) && (only.empty() || in(only));
}

// Takes away every light whose name `keeps` denies, with all that is told of it.
template <class Keeps>
void KeepLights(const Keeps& keeps, Session& session) {
  std::erase_if(session.lights, [&](const auto& light) { return !keeps(light.name); });
  const auto of_others = [&](const SessionReading& row) { return !keeps(row.reading.light); };
  std::erase_if(session.readings, of_others);
  std::erase_if(session.state_readings, of_others);
  std::erase_if(session.captures, [&](const auto& capture) { return !keeps(capture.light); });
}

}  // namespace lightcal
