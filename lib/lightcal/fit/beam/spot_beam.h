// SPDX-License-Identifier: Apache-2.0
// A spot's cone and aim from meters standing in and around its beam.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Prior of a stated aim, 1 sigma: how well people aim a lamp on paper.
inline constexpr double kAimSigmaDegrees = 3.0;

struct SpotBeam {
  Radians inner, outer;  // half angles
  Radians inner_sd, outer_sd;
  Vec3 aim{};                                // unit
  Radians aim_sd;                            // of each of its two directions
  double ln_intensity_extra_variance = 0.0;  // what not knowing cone and aim adds to that of ln I
};

// Whether cone or aim are to be found: a spot of known position without outer_deg (or without aim)
// whose placed readings number at least kFewestForBeam.
[[nodiscard]] bool NeedsBeam(const Observations& observations, const LightDescription& light);
inline constexpr int kFewestForBeam = 7;

// Least squares of m = I f(theta) cr/r^2 with f squared linear between the cosines of inner and
// outer (glTF, Filament, Frostbite), r from the position moved d0 behind the aim, d0 by its prior
// (estimate_light.h); stated inner, outer and aim are kept (the aim within its prior). Readings
// beyond the cone count too: they tell where it ends. Started from the best of a grid of cones.
// Refused: beam_unknown where the readings do not tell the outer angle within a third.
[[nodiscard]] Result<SpotBeam> FitSpotBeam(const Observations& observations,
                                           const LightDescription& light);

// The description with what was found in the places left open.
[[nodiscard]] LightDescription WithBeam(const LightDescription& light, const SpotBeam& beam);
// inner_deg, outer_deg and aim with their intervals.
void FillBeam(const SpotBeam& beam, const LightDescription& light, FittedLight& out);

}  // namespace lightcal::fit
