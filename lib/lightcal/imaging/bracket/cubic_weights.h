// SPDX-License-Identifier: Apache-2.0
// Cubic interpolation between samples that lie one apart.
#pragma once

#include <array>

namespace lightcal {

// Catmull and Rom's weights of four neighbours at the share t between the middle two.
// Source: Keys, Cubic Convolution Interpolation (1981), a = -1/2.
[[nodiscard]] constexpr std::array<float, 4> CubicWeightsAt(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {0.5F * (-t3 + 2.0F * t2 - t), 0.5F * (3.0F * t3 - 5.0F * t2 + 2.0F),
          0.5F * (-3.0F * t3 + 4.0F * t2 + t), 0.5F * (t3 - t2)};
}

// What they change by with t.
[[nodiscard]] constexpr std::array<float, 4> CubicSlopesAt(float t) {
  const float t2 = t * t;
  return {0.5F * (-3.0F * t2 + 4.0F * t - 1.0F), 0.5F * (9.0F * t2 - 10.0F * t),
          0.5F * (-9.0F * t2 + 8.0F * t + 1.0F), 0.5F * (3.0F * t2 - 2.0F * t)};
}

}  // namespace lightcal
