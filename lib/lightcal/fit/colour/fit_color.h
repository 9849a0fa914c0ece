// SPDX-License-Identifier: Apache-2.0
// Colour of one light from all its readings that saw colour.
#pragma once

#include <span>

#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// 1 sigma of one reading's colour where the reading does not say. A spectrometer of the C-800 class
// is specified to +-0.003 in x and y (CIE illuminant A), taken as two standard deviations; a filter
// colorimeter to about twice that; a camera is profiled to 5 mired and 0.005 of Duv at best; a
// number of unknown origin is no better than a colorimeter's. A camera's reading may say its own
// (Reading::sigma_mired).
inline constexpr double kSigmaXySpectrometer = 0.0015;
inline constexpr double kSigmaXyColorimeter = 0.003;
inline constexpr double kSigmaXyUnknown = 0.003;
inline constexpr double kSigmaMiredCamera = 5.0;
inline constexpr double kSigmaDuvCamera = 0.005;
// A colour temperature without a Duv is taken to lie on the locus within what lamps are sorted to
// (ANSI C78.377 quadrangles reach +-0.006).
inline constexpr double kSigmaDuvAssumed = 0.006;

// Weighted mean in (mired, Duv) of the light's readings with the lamp on, each by the covariance of
// its source. Readings of one meter and one kind of source share their error: more of them do not
// lower it, their scatter adds to it. Where a reading's chromaticity has no CCT the mean is taken
// in xy and the CCT withheld with the warning cct_withheld. Empty when no reading holds colour.
[[nodiscard]] FittedColor FitColor(const Session& session, const LightDescription& light,
                                   Warnings& warnings, CctMethod method = CctMethod::kExact);

}  // namespace lightcal::fit
