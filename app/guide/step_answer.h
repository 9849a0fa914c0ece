// SPDX-License-Identifier: Apache-2.0
// What a person may answer where a reading is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal::app {

struct StepAnswer {
  enum class Kind : std::uint8_t { kMeasure, kTyped, kMoved, kSkip, kUndo, kQuit };
  Kind kind = Kind::kMeasure;
  std::string typed;               // kTyped: "192lx,2900K"
  std::optional<Metres> distance;  // kMoved, kTyped with @: where the meter stands instead
};

// "" (measure), "0.8m" or "at 0.8m" (moved), "s" or "skip", "u" or "undo", "q" or "quit"; of a meter without a
// cable also "192", "17.8fc", "192,2900K" and "192lx@0.8m". A bare number is lux where readings are
// typed, else metres.   Wrong usage: anything else, a distance that is not above zero.
[[nodiscard]] Result<StepAnswer> ParseStepAnswer(const std::string& text, bool typed);

}  // namespace lightcal::app
