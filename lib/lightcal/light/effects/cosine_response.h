// SPDX-License-Identifier: Apache-2.0
// A meter whose response to slanting light is not the cosine.
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// f2 of a class B meter, DIN 5032-7.
inline constexpr double kCosineF2Default = 0.03;

// f2 of a head that reads slanting light low by 1 - cos(tilt) of it, CIE S 023: the mean of its
// error's size up to 80 degrees, weighted by sin(2 tilt) = sin^2(80) - 2/3 (1 - cos^3(80)).
inline constexpr double kF2OfSlant = 0.3066;

// What a head of that f2 may be off by at a tilt, beside facing the lamp. Diffusers lose, or win,
// more the more the light slants; which of both, nobody says.
[[nodiscard]] inline double SlantError(double f2, double cosine) {
  return f2 / kF2OfSlant * (1.0 - cosine);
}

//   bound = f2 x {1 below 30 degrees, 2 to 60, 5 beyond} of tilt (an engineering assumption; f2 is
//   an average over angles). A facing meter has none: its response is normalised there.
[[nodiscard]] inline EffectFinding FindCosineResponse(const Scene& scene) {
  const double tilt = DegreesFromRadians(Radians(LargestTilt(scene)));
  if (!(tilt > 0.0)) {
    return {0.0, Treatment::kModelled, 0.0, "the meter faces the lamp, where it was calibrated"};
  }
  const double factor = tilt < 30.0 ? 1.0 : (tilt <= 60.0 ? 2.0 : 5.0);
  if (scene.cosine_f2) {
    return {factor * *scene.cosine_f2, Treatment::kWidens, 0.0, "the meter's stated f2"};
  }
  return {factor * kCosineF2Default, Treatment::kInsideSigma, 0.0,
          "no cosine_f2 given (class B: 3 %); the meter's sigma is taken to hold it"};
}

}  // namespace lightcal::effects
