// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal {
namespace {

std::string PlaceText(const Vec3& at) {
  return "(" + RoundedText(at[0], 3) + ", " + RoundedText(at[1], 3) + ", " + RoundedText(at[2], 3) +
         ")";
}

std::string WhereText(const PlannedReading& reading) {
  if (reading.distance) {
    const std::string at = " at " + RoundedText(reading.distance->value(), 3) + " m";
    if (!reading.off_axis) return at;
    const double degrees = DegreesFromRadians(*reading.off_axis);
    return " " + RoundedText(std::abs(degrees), 3) + " degrees off the axis," + at;
  }
  if (!reading.position_m) return "";
  std::string text = " at " + PlaceText(*reading.position_m) + " m";
  if (reading.normal) text += ", facing " + PlaceText(*reading.normal);
  return text;
}

}  // namespace

std::string SayPlannedReading(const PlannedReading& reading) {
  switch (reading.action) {
    case PlannedAction::kShadowCard:
      return "add a shadow-card reading" + WhereText(reading) + " (block only the direct beam)";
    case PlannedAction::kLampOff:
      return "read once with the lamp off";
    case PlannedAction::kRead:
      break;
  }
  const bool facing = reading.distance.has_value();
  return "read" + WhereText(reading) + (facing ? ", facing the lamp" : "");
}

}  // namespace lightcal
