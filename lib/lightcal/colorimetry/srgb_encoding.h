// SPDX-License-Identifier: Apache-2.0
// The transfer function of sRGB.   Source: IEC 61966-2-1.
#pragma once

#include <cmath>

namespace lightcal {

// A linear component in [0,1] to the one that is written, and back; unclamped beyond.
[[nodiscard]] inline double SrgbEncoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
[[nodiscard]] inline double SrgbDecoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// d SrgbDecoded / d encoded.
[[nodiscard]] inline double SrgbDecodedSlope(double encoded) {
  return encoded <= 0.04045 ? 1.0 / 12.92 : 2.4 / 1.055 * std::pow((encoded + 0.055) / 1.055, 1.4);
}

}  // namespace lightcal
