// SPDX-License-Identifier: Apache-2.0
// The colour that Godot makes of a light's temperature.
#pragma once

#include <algorithm>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/rgb_spaces.h"

namespace lightcal {

// What light_temperature [K] multiplies the light's colour by: Krystek's locus, largest
// component 1.
[[nodiscard]] inline Rgb GodotTemperatureColor(double t) {
  const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                   (1.0 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
  const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                   (1.0 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
  const Rgb c = LinearSrgbFromXyz(XyzFromXyAtUnitY(XyFromUv1960({u, v})));
  const double largest = std::max({c.r, c.g, c.b});
  const auto part = [&](double x) { return std::clamp(x / largest, 0.0, 1.0); };
  return {part(c.r), part(c.g), part(c.b)};
}

}  // namespace lightcal
