// SPDX-License-Identifier: Apache-2.0
// Correlated colour temperature and distance from the Planckian locus.
#pragma once

#include <optional>
#include <string>

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

// Colour temperatures that a lamp may have: nothing that shines for the eye is colder than 1000 K,
// and above 100 000 K all are one blue.
inline constexpr Kelvin kColdestLamp{1000.0};
inline constexpr Kelvin kHottestLamp{100000.0};
[[nodiscard]] constexpr bool IsTemperatureOfLamp(Kelvin temperature) {
  return temperature >= kColdestLamp && temperature <= kHottestLamp;
}

// The point of the Planckian locus nearest in CIE 1960 uv, with
//   locus: CIE 1931 2 deg, 1 nm sum 360-830 nm, c2 = 1.4388e-2 m K, n = 1.
//   duv:   signed distance, positive above the locus (greenish).
// temperature and duv are filled for kOk, kFarFromLocus and kBelowRange (never below 400 K, where
// the search ends and temperature stands at that end); at kBeyondInfinity temperature is infinite
// and duv the component normal to the locus. Error against the definition: under 1e-5 K to 25000 K,
// 1e-7 relative to 100000 K, duv under 1e-11. The far side of the locus (duv < -0.1) has several
// nearest points; the globally nearest is given. Sources: CIE 15:2018; Li et al., Opt. Express 24,
// 14066 (2016) for the definition.
struct CctResult {
  Kelvin temperature{0.0};
  double duv = 0.0;
  CctStatus status = CctStatus::kNotAChromaticity;
  [[nodiscard]] bool valid() const { return status == CctStatus::kOk; }
};
[[nodiscard]] CctResult CctFromUv(Uv1960 uv);
[[nodiscard]] CctResult CctFromXy(Xy xy);

// "-0.0031": two digits; what arithmetic leaves of 0 is 0.
[[nodiscard]] std::string DuvText(double duv);

// How (mired, duv) move with (x, y), for propagating uncertainty: the 2x2 Jacobian of CctFromXy in
// reciprocal temperature. Across the locus dduv = n . d(u,v); along it, with radius of curvature R,
//   dmired = t . d(u,v) / (|locus speed| (1 - duv/R)),
// so the same chromaticity error costs more CCT below the locus than above.
struct CctJacobian {
  double dmired_dx = 0.0, dmired_dy = 0.0;
  double dduv_dx = 0.0, dduv_dy = 0.0;
};
// Absent where there is no CCT (kBeyondInfinity, kNotAChromaticity) or the point is the centre of
// curvature.
[[nodiscard]] std::optional<CctJacobian> CctJacobianAt(Xy xy);

// Variances of a chromaticity (dimensionless, 1 sigma squared).
struct XyCovariance {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};
// Standard deviations and covariance of (mired, duv): J C J^T.
struct CctUncertainty {
  Mireds sd_mired{0.0};
  double sd_duv = 0.0;
  double covariance = 0.0;  // of mired and duv
};
[[nodiscard]] CctUncertainty PropagateToCct(const CctJacobian& jacobian,
                                            const XyCovariance& covariance);

// The chromaticity at temperature T (K, > 0; infinity allowed) on the Planckian locus, moved by duv
// along the locus normal. The inverse of CctFromUv within |duv| <= 0.05.
[[nodiscard]] Uv1960 UvFromCct(Kelvin temperature, double duv = 0.0);
[[nodiscard]] Xy XyFromCct(Kelvin temperature, double duv = 0.0);

}  // namespace lightcal
