// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/wall_part.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/fit/fit_light.h"

namespace lightcal {

namespace {

double LampFigureOf(const FittedLight& light) {
  const auto& strength = light.intensity_cd ? light.intensity_cd : light.illuminance_lx;
  return strength ? strength->value : 0.0;
}

// Facing the lamp, at the reference.
double WallsAt(const FittedLight& reference, const Reading& reading) {
  if (!reading.distance) return 0.0;
  const auto room = PredictInRoom(reference, *reading.distance, 0.0);
  return room && *room ? (*room)->walls_lx.value : 0.0;
}

}  // namespace

double WallPartOf(const Session& session, const FittedLight& lamp, const ResidualRow& row) {
  const bool walls = session.surroundings != Surroundings::kDark;
  if (!walls || row.index < 0) return 0.0;
  int index = 0;
  const Reading* reading = nullptr;
  for (const SessionReading& of : session.readings) {
    if (of.reading.light == lamp.name && index++ == row.index) reading = &of.reading;
  }
  if (reading == nullptr) return 0.0;
  // Read by its place: what of it the fit holds for the walls' own.
  if (reading->position_m) return std::clamp(row.walls_lx.value_or(0.0), 0.0, row.predicted_lx);
  if (!row.distance_m) return 0.0;
  // What the lamp alone gives there is not what it gives on its axis: the fit has parted the two.
  if (reading->off_axis.value() != 0.0) {
    const double facing = WallsAt(lamp, *reading) * std::cos(reading->tilt.value());
    return std::min(row.predicted_lx, row.walls_lx.value_or(facing));
  }
  const auto alone = PredictIlluminance(lamp, Metres(*row.distance_m), 0.0);
  if (!alone) return 0.0;
  const double ambient = lamp.ambient_lx ? lamp.ambient_lx->value : 0.0;
  const double lamp_lx =
      (alone->model_lx.value - ambient) * std::cos(reading->tilt.value()) + ambient;
  return std::max(0.0, row.predicted_lx - lamp_lx);
}

int TakeReadingsOfState(const FittedLight& reference, FittedLight& there, Session& session) {
  if (SameState(reference.state, there.state)) {
    there = reference;
    return static_cast<int>(there.residuals.size());
  }
  std::erase_if(session.readings,
                [&](const SessionReading& row) { return row.reading.light == there.name; });
  const double times = LampFigureOf(there) / LampFigureOf(reference);
  const double ambient = there.ambient_lx ? there.ambient_lx->value : 0.0;
  for (const SessionReading& one : session.state_readings) {
    const Reading& reading = one.reading;
    if (reading.light != there.name || !SameState(reading.state, there.state)) continue;
    if (!reading.illuminance || reading.shadow_card || reading.over_range) continue;
    ResidualRow row;
    row.index = static_cast<int>(there.residuals.size());
    if (reading.distance) row.distance_m = reading.distance->value();
    row.measured_lx = reading.illuminance->value();
    const double tilted = std::cos(reading.tilt.value());
    row.walls_lx = times * WallsAt(reference, reading) * tilted;
    row.predicted_lx = *row.walls_lx + ambient;
    if (reading.distance) {
      const auto alone = PredictIlluminance(there, *reading.distance, 0.0);
      if (alone) row.predicted_lx += (alone->model_lx.value - ambient) * tilted;
    }
    there.residuals.push_back(row);
    session.readings.push_back(one);
  }
  for (LightDescription& light : session.lights) {
    if (light.name == there.name) light = DescriptionAt(light, there.state);
  }
  return static_cast<int>(there.residuals.size());
}

}  // namespace lightcal
