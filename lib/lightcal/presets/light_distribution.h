// SPDX-License-Identifier: Apache-2.0
// A fitted lamp's intensity by direction, as engines read it from a photometric file.
#pragma once

#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// Type C over the whole sphere, 0 to 180 degrees, with one value at nadir and one at zenith for all
// planes; nothing beyond where a measured table ends. By kind:
//   photometric  its own table; of a spot too that has one: its stated beam, drawn
//   point, sphere  intensity everywhere
//   spot         the squared-linear profile of spot_cone.h (Frostbite, glTF), nodes at both cones;
//                without a cone as a point
//   disk, rect   I cos(gamma)
//   tube         I sqrt(1 - sin^2(gamma) cos^2(C)): its length lies along C0, as the fit has it and
//                as LM-63 has a luminaire's length (EULUMDAT's own habit is C90)
// Absent: lights at infinity, lights without an intensity.   Fails: as IntensityTable::Make.
[[nodiscard]] Result<std::optional<IntensityTable>> DistributionOf(const FittedLight& lamp);

// The same lamp for engines whose distributions are round about the aim: one plane, the mean of its
// interpolant round C at each gamma, which keeps the flux. Type C.
struct RoundTable {
  IntensityTable table;
  double worst_cd = 0.0;  // largest |mean - table| in any direction
  Radians worst_at{0.0};  // its gamma
};
[[nodiscard]] Result<RoundTable> RoundAboutAim(const IntensityTable& table);

}  // namespace lightcal
