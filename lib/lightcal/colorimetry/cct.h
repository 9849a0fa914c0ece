// SPDX-License-Identifier: Apache-2.0
// Correlated colour temperature and distance from the Planckian locus.
#pragma once

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Whether the CCT of a chromaticity means anything (CIE 15:2018 9.4: not beyond |Duv| 0.05).
enum class CctStatus {
  kOk,
  kFarFromLocus,      // |Duv| > 0.05 + 1e-9
  kBelowRange,        // colder than 1000 K
  kBeyondInfinity,    // the nearest point is T = infinity
  kNotAChromaticity,  // not finite, or y <= 0
};

// The point of the Planckian locus nearest in CIE 1960 uv, with
//   locus: CIE 1931 2 deg, 1 nm sum 360-830 nm, c2 = 1.4388e-2 m K, n = 1.
//   duv:   signed distance, positive above the locus (greenish).
// temperature and duv are filled for kOk, kFarFromLocus and kBelowRange; at kBeyondInfinity
// temperature is infinite and duv the component normal to the locus. Sources: CIE 15:2018;
// Li et al., Opt. Express 24, 14066 (2016) for the definition.
struct CctResult {
  Kelvin temperature{0.0};
  double duv = 0.0;
  CctStatus status = CctStatus::kNotAChromaticity;
  [[nodiscard]] bool valid() const { return status == CctStatus::kOk; }
};
[[nodiscard]] CctResult CctFromUv(Uv1960 uv);
[[nodiscard]] CctResult CctFromXy(Xy xy);

// The chromaticity at temperature T (K, > 0; infinity allowed) on the Planckian locus, moved by duv
// along the locus normal. The inverse of CctFromUv within |duv| <= 0.05.
[[nodiscard]] Uv1960 UvFromCct(Kelvin temperature, double duv = 0.0);
[[nodiscard]] Xy XyFromCct(Kelvin temperature, double duv = 0.0);

}  // namespace lightcal
