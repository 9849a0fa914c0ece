// SPDX-License-Identifier: Apache-2.0
// What of a calibration can be done with more or less work, each a row of one table.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "lightcal/records/accuracy_profile.h"
#include "lightcal/tradeoff/outcome.h"

namespace lightcal::tradeoff {

struct Knob {
  std::string_view name;
  std::string_view what;                     // a phrase: "how the estimate is solved"
  Stage stage;                               // where it takes its time
  std::span<const std::string_view> levels;  // strictest first
  std::size_t usual;                         // the level of a profile that says nothing
  void (*set)(AccuracyProfile& profile, std::size_t level);
};

[[nodiscard]] std::span<const Knob> Knobs();

// The profile whose every knob stands at its strictest, and its independent check: another solver,
// another quadrature of the walls and other draws, which must come to the same answer.
[[nodiscard]] AccuracyProfile StrictProfile(double tolerance_relative);
[[nodiscard]] AccuracyProfile StrictCheckProfile(double tolerance_relative);

}  // namespace lightcal::tradeoff
