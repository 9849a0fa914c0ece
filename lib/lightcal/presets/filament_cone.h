// SPDX-License-Identifier: Apache-2.0
// What Filament makes of a spot's angles. Internal to this room.
#pragma once

#include "lightcal/core/units.h"

namespace lightcal {

// The parabola that FLightManager::setSpotLightCone takes for a cosine, 0 to pi/2:
//   y = 16 z^2 + 8 z, z = x/2pi - 1/4;  cos x ~ y + .225 y (|y| - 1)
// At most .00077 high (at 42 degrees), exact at 0, 60 and 90: of a cone of 20/22 degrees, whose
// cosines are .0125 apart, 5.7 % of the axial light. Lumens of a FOCUSED_SPOT are shared out by it
// too (.5 % at 22 degrees). Its t^2 between the two is the punctual law.
// Sources: google/filament libs/math/include/math/fast.h (fast::cos),
// filament/src/components/LightManager.cpp; rendered in 1.53.4 (tests/engines/render/beams.py).
[[nodiscard]] double FilamentCosine(Radians angle);

// The angle to write, so that Filament's cosine of it is the true one of `angle`; 0 to pi/2.
[[nodiscard]] Radians AngleForFilament(Radians angle);

}  // namespace lightcal
