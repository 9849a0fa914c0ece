// SPDX-License-Identifier: Apache-2.0
// sRGB for what reads pictures and presets back. The exporters have their own, so that one slip
// cannot hide in both.
#pragma once

#include <cmath>

namespace lightcal::app {

// IEC 61966-2-1: an encoded component in 0..1 -> linear, and back.
[[nodiscard]] inline double SrgbDecoded(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
[[nodiscard]] inline double SrgbEncoded(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

// Slope of the first.
[[nodiscard]] inline double SrgbDecodedSlope(double v) {
  return v <= 0.04045 ? 1.0 / 12.92 : 2.4 / 1.055 * std::pow((v + 0.055) / 1.055, 1.4);
}

// Luminance of linear Rec. 709, whose white D65 has 1. Rgb: anything of three numbers.
template <class Rgb>
[[nodiscard]] double Rec709Luminance(const Rgb& rgb) {
  return 0.2126390 * rgb[0] + 0.7151687 * rgb[1] + 0.0721923 * rgb[2];
}

}  // namespace lightcal::app
