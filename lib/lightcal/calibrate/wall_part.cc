// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/wall_part.h"

#include <algorithm>
#include <cmath>

#include "lightcal/fit/fit_light.h"

namespace lightcal {

double WallPartOf(const Session& session, const FittedLight& lamp, const ResidualRow& row) {
  const bool walls = session.surroundings == Surroundings::kIndoors;
  if (!walls || !row.distance_m || row.index < 0) return 0.0;
  int index = 0;
  const Reading* reading = nullptr;
  for (const SessionReading& of : session.readings) {
    if (of.reading.light == lamp.name && index++ == row.index) reading = &of.reading;
  }
  if (reading == nullptr || reading->position_m) return 0.0;
  const auto alone = PredictIlluminance(lamp, Metres(*row.distance_m), 0.0);
  if (!alone) return 0.0;
  const double ambient = lamp.ambient_lx ? lamp.ambient_lx->value : 0.0;
  const double lamp_lx =
      (alone->model_lx.value - ambient) * std::cos(reading->tilt.value()) + ambient;
  return std::max(0.0, row.predicted_lx - lamp_lx);
}

}  // namespace lightcal
