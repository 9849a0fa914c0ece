// SPDX-License-Identifier: Apache-2.0
// Readings that a person could take next, and what the minutes they take buy.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"

namespace lightcal {

enum class PlannedAction : std::uint8_t { kRead, kShadowCard, kLampOff };

struct PlannedReading {
  PlannedAction action = PlannedAction::kRead;
  std::optional<Metres> distance;  // facing the lamp
  std::optional<Vec3> position_m;  // or at this place
  std::optional<Vec3> normal;
  Lux expected{0.0};                  // what the meter will show if the lamp is what it now seems
  double u95_relative = 0;            // of the intensity (illuminance) once it is taken: half
  double u95_stops = 0;               // the same: 1/2 log2(high/low), infinite down to 0
  std::optional<Radians> off_axis{};  // with distance: seen from the lamp, from its axis
  std::optional<double> beam_u95_deg{};  // of a beam's full angle once it is taken
};

// Of a person, in minutes: a reading where the meter stands, a shadow card held before it, the
// meter set up at another place.
struct MeasuringMinutes {
  double reading = 2.0, card = 1.0, move = 3.0;
};

struct LadderStep {
  PlannedReading reading;
  std::string say;             // "read at 1.41 m, facing the lamp"
  double minutes = 0.0;        // of this step
  double total_minutes = 0.0;  // with those before it
  bool meter_limits = false;   // more than half of the variance left is the meter's calibration
};

// What the next minutes of measuring one light buy, each step on top of the former.
struct MinutesLadder {
  std::string light;
  std::optional<double> u95_relative;  // now, half the interval's width; absent before any reading
  double u95_stops = 0.0;              // the same in stops; infinite: it reaches down to 0
  // What the calibration of the meter (of all that read) leaves however often it reads; 0 where
  // readings of one share nothing.
  double meter_u95_relative = 0.0;
  std::vector<LadderStep> steps;
};

}  // namespace lightcal
