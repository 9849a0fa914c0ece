// SPDX-License-Identifier: Apache-2.0
// What a meter facing a lamp sees at a distance, by all that lamp and room may be: mixtures of
// normals of ln E [lx]. Internal to fit.
#pragma once

#include <vector>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/core/units.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

struct PredictedParts {
  std::vector<NormalPart> whole;  // the lamp, the walls, other light
  std::vector<NormalPart> walls;  // of it; empty where none throw its light back
};

// Of light.in_room; empty where that is, and where the meter stands behind all that it may be.
[[nodiscard]] PredictedParts PredictParts(const FittedLight& light, Metres distance);

}  // namespace lightcal::fit
