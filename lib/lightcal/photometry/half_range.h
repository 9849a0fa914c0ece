// SPDX-License-Identifier: Apache-2.0
// Whether a number survives in a half float (IEEE 754 binary16), the format of render targets and
// OpenEXR. A 32-bit float reaches 3.4e38: it is the half that the sun overflows.
#pragma once

#include <string_view>

namespace lightcal {

inline constexpr double kLargestHalf = 65504.0;
inline constexpr double kSmallestNormalHalf = 0x1p-14;     // 6.1e-5: below it digits are lost
inline constexpr double kSmallestSubnormalHalf = 0x1p-24;  // 6.0e-8

enum class HalfRange {
  kFits,       // relative error at most 2^-11
  kOverflow,   // beyond +-65504
  kSubnormal,  // kept with fewer digits
  kUnderflow,  // becomes 0
};
// Zero fits; anything not finite overflows.
[[nodiscard]] HalfRange ClassifyHalf(double value);
// "fits" "overflow" "subnormal" "underflow"
[[nodiscard]] std::string_view HalfRangeName(HalfRange range);

// A light's value as a shader that pre-exposes stores it: value x exposure (exposure.h).
// Pre-exposure alone does not cure overflow: a 2e9 cd/m^2 sun at EV100 14 is still 101 725.
[[nodiscard]] constexpr double PreExposed(double value, double exposure) {
  return value * exposure;
}

}  // namespace lightcal
