// SPDX-License-Identifier: Apache-2.0
// CIECAM02 uniform colour space under the viewing conditions of CIE 224.
#pragma once

#include <array>

#include "lightcal/colorimetry/chromaticity.h"

namespace lightcal {

// J' = 1.7 J / (1 + 0.007 J), a' = M' cos h, b' = M' sin h, M' = ln(1 + 0.0228 M) / 0.0228.
struct Cam02Ucs {
  double J = 0.0, a = 0.0, b = 0.0;
};

// CIECAM02 with L_A = 100 cd/m2, Y_b = 20, average surround (c = 0.69, N_c = 1) and complete
// adaptation (D = 1) to one white of Y = 100; colours with Y relative to it.
// Source: CIE 159:2004; Luo, Cui and Li, Color Res. Appl. 31, 320 (2006); conditions: CIE 224:2017.
// Colours without a hue, and those beyond the model (negative cone responses), have a = b = 0.
class Cam02UcsUnder {
 public:
  explicit Cam02UcsUnder(const Xyz& white);
  [[nodiscard]] Cam02Ucs Of(const Xyz& color) const;

 private:
  Matrix3 cone_from_xyz_{};  // adapted, times F_L / 100
  double white_response_ = 0.0;
};

}  // namespace lightcal
