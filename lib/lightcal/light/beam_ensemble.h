// SPDX-License-Identifier: Apache-2.0
// What a data sheet's lumens and beam angle leave open about the peak intensity.
#pragma once

#include <functional>
#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Solid angle Phi/I_peak [sr] of the plausible beams, narrowest and widest.
struct BeamSolidAngles {
  Steradians least{0.0};
  Steradians most{0.0};
};

// A lamp that shines wider is no beam: its intensity is nowhere half of the middle's.
inline constexpr Radians kWidestBeam = RadiansFromDegrees(170.0);

// The beams whose intensity is half the peak at beam/2 from the axis (and, when given, a tenth at
// field/2), beam and field being full angles as data sheets print them (IES LM-79, CIE 121).
//   beam only: uniform cone of half angle beam/2; Gaussian; cos^n; cos^n that carries two thirds
//     of the flux, the rest being spill outside the beam (reflector lamps reach that).
//   beam and field: exp(-ln2 (t/tb)^p); 1/(1 + (t/tb)^q); a trapezoid, straight through both.
// Integrated numerically over 0..90 degrees. Holds for 0 < beam < field <= 180 degrees (beam alone
// below kWidestBeam). Refused: bad_beam.
[[nodiscard]] Result<BeamSolidAngles> BeamEnsemble(Radians beam, std::optional<Radians> field);

// One of those beams, to be drawn: I(theta)/I_peak, theta from the axis, nothing beyond 90 degrees;
// half the peak at beam/2 exactly (a tenth at field/2), Phi/I_peak as told wherever such a beam can
// have it, else as near as it can.
//   beam only: cos^n, and of 1/2 + 1/2 max(0, (cos theta - c)/(1 - c)), c = cos(beam/2), as much as
//     carries the rest: what the fixture spills.
//   beam and field: of the narrowest and the widest of the three together.
// Absent for angles that BeamEnsemble refuses.
using RelativeIntensity = std::function<double(Radians)>;
[[nodiscard]] std::optional<RelativeIntensity> BeamOf(Radians beam, std::optional<Radians> field,
                                                      Steradians flux_per_candela);

// How far those beams lie off `drawn`, one of them: the farthest at each angle, taken for the end
// of a 95 % interval as their solid angles are; 1 sigma, in parts of the peak. Of a beam angle
// alone the widest is BeamOf's. Angles as BeamEnsemble takes them.
[[nodiscard]] RelativeIntensity DoubtOfBeams(Radians beam, std::optional<Radians> field,
                                             RelativeIntensity drawn);

}  // namespace lightcal
