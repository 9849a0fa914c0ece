// SPDX-License-Identifier: Apache-2.0
// A spectrum sampled more coarsely than its narrowest line.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A phosphor's band, and a laser's or a discharge lamp's line as a spectrometer shows it.
inline constexpr double kBandDefault_nm = 20.0;
// V(lambda) itself is no narrower than a band of this width.
inline constexpr double kLuminousBand_nm = 80.0;

// Sum over a Gaussian band of full width w in steps of h, wherever the steps begin (Poisson's
// formula):  2 sum exp(-2 (pi k s/h)^2), s = w/2.355.   Safe while h <= w/2.
[[nodiscard]] inline double BandSumBound(double step_nm, double width_nm) {
  const double s = width_nm / 2.3548200450309493 / step_nm;
  const double a = std::numbers::pi * s;
  double sum = 0.0;
  for (int k = 1; k <= 6; ++k) sum += 2.0 * std::exp(-2.0 * k * k * a * a);
  return std::min(1.0, sum);
}

//   bound = that of the narrowest line and of V(lambda).
[[nodiscard]] inline EffectFinding FindSpectralStep(const Scene& scene) {
  if (!scene.spectrum) return NotApplicable("no illuminance of a spectrum");
  const double width = scene.spectrum->narrowest_nm.value_or(kBandDefault_nm);
  return {BandSumBound(scene.spectrum->step_nm, std::min(width, kLuminousBand_nm)),
          Treatment::kInsideSigma, 0.0, "the step against the narrowest line"};
}

}  // namespace lightcal::effects
