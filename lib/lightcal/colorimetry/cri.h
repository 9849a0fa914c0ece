// SPDX-License-Identifier: Apache-2.0
// CIE colour rendering index of a light.
#pragma once

#include <array>

#include "lightcal/colorimetry/rendering_input.h"

namespace lightcal {

// R_i = 100 - 4.6 dE_i in CIE 1964 U*V*W* after von Kries adaptation to the reference light, for
// CIE test colours 1-14 and (the last) JIS Z 8726's sample 15; Ra is the mean of R_1 to R_8,
// unrounded. The reference is a black body below 5000 K, CIE daylight from there (M1, M2
// unrounded), of the light's exact CCT, so Ra jumps at 5000 K. Nothing is clamped: saturated lights
// have R_9 far below 0. chromaticity_difference: distance of light and reference in CIE 1960 uv.
// CIE 13.3 asks for less than 5.4e-3; beyond it the indices are given, and mean little. Source:
// CIE 13.3-1995, chapters 5-6.
struct ColorRendering {
  double Ra = 0.0;
  std::array<double, 15> R{};
  double chromaticity_difference = 0.0;
};
inline constexpr double kLargestCriChromaticityDifference = 5.4e-3;

[[nodiscard]] ColorRendering ColorRenderingOf(const RenderingInput& light);

}  // namespace lightcal
