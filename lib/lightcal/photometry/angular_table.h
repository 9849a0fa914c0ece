// SPDX-License-Identifier: Apache-2.0
// What the photometric files IES LM-63 and EULUMDAT hold: intensity by direction. No
// wavelength is in them.
#pragma once

#include <span>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Flux of an axially symmetric intensity given at angles from the axis, linear in the angle between
// the samples and nothing outside them:
//   Phi = 2 pi int I(theta) sin(theta) dtheta, integrated exactly (a constant table over 0..pi
//   gives 4 pi I to rounding, at any step).
// angles strictly increasing within 0..pi, at least two, as many intensities, all finite, none
// negative.   Fails: refused/"bad_table".
[[nodiscard]] Result<Lumens> FluxOfAngularTable(std::span<const Radians> angles,
                                                std::span<const Candela> intensities);

}  // namespace lightcal
