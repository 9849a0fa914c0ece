// SPDX-License-Identifier: Apache-2.0
// CIE daylight (D illuminants).
#pragma once

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Chromaticity of CIE daylight of correlated temperature T,
//   x = -4.6070e9/T^3 + 2.9678e6/T^2 + 0.09911e3/T + 0.244063   4000 <= T <= 7000 K
//   x = -2.0064e9/T^3 + 1.9018e6/T^2 + 0.24748e3/T + 0.237040   7000 <  T <= 25000 K
//   y = -3 x^2 + 2.870 x - 0.275
// Source: CIE 15:2018, eq. 4.2 - 4.4. T is nominal: the exact CCT of the result is 1.3 K lower at
// 6504 K, 46 K at 20000 K. Only the daylight locus: for lamps and below 4000 K see UvFromCct.
// Fails: refused/"out_of_range" outside 4000-25000 K.
[[nodiscard]] Result<Xy> DaylightXy(Kelvin temperature);

// T of an illuminant that was named when c2 stood at 1.4380e-2 m K: D65 is 6500 x 1.4388/1.4380 =
// 6503.6 K, D50 5002.8 K.  Source: CIE 15:2018 4.1.2, note on c2.
[[nodiscard]] Kelvin DaylightTemperatureOfName(Kelvin named);

// Weights of the components S1 and S2 in CIE daylight of chromaticity xy, unrounded,
//   M1 = (-1.3515 - 1.7703 x + 5.9114 y)/M, M2 = (0.0300 - 31.4424 x + 30.0717 y)/M,
//   M = 0.0241 + 0.2562 x - 0.7341 y.   Source: CIE 15:2018, eq. 4.6 - 4.7.
struct DaylightWeights {
  double m1 = 0.0, m2 = 0.0;
};
[[nodiscard]] DaylightWeights DaylightWeightsOf(Xy xy);

// Relative spectrum of CIE daylight, 300-830 nm at 1 nm, 100 at 560 nm,
//   S = S0 + M1 S1 + M2 S2,  M1 and M2 of DaylightWeightsOf rounded to three decimals,
// S0-S2 linear between the rows of CIE's table.  Source: CIE 15:2018, eq. 4.5 - 4.7.
// Fails as DaylightXy.
[[nodiscard]] Result<Spectrum> DaylightSpectrum(Kelvin temperature);

}  // namespace lightcal
