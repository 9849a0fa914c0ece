// SPDX-License-Identifier: Apache-2.0
// What `simulate` did with each effect of each lamp, why, and at what price.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/light/illuminance_map.h"
#include "lightcal/records/document.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// One effect of one lamp: what the gate did and why.
struct EffectRow {
  std::string light;
  std::string effect;  // "finite_source", "room_bounce"
  std::string state;   // "on", "off"
  std::string where;   // shares of the points, in words; "" = nowhere
  std::string reason;
  double cost_ns = 0.0;         // declared price of what was evaluated, of one processor
  std::optional<double> bound;  // of what was left off, relative to the lamp's direct light
  records::Node points = records::Node::Table();  // how many, by form
  std::int64_t evaluations = 0;
};

// Two rows a lamp, its own size and the walls' light. One account a lamp, in the lamps' order.
// `surroundings`: a session's own.
[[nodiscard]] std::vector<EffectRow> EffectRowsOf(const std::vector<PlacedLamp>& lamps,
                                                  const std::vector<LampAccount>& accounts,
                                                  const MapSettings& settings,
                                                  std::optional<Surroundings> surroundings);

}  // namespace lightcal::app
