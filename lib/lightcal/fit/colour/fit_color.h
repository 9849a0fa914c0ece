// SPDX-License-Identifier: Apache-2.0
// Colour of one light from all its readings that saw colour.
#pragma once

#include <string>

#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/colour/off_wall.h"
#include "lightcal/fit/colour/other_light.h"
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

// 1 sigma by which two readings of one meter differ: of x and y, and of lux over their value.
inline constexpr double kRepeatXy = 0.0005;
inline constexpr double kRepeatLux = 0.01;

struct ColorFit {
  FittedColor color;
  std::string note{};  // what would make it surer, "" = nothing the readings show
};

// The lamp's colour by its readings, each by the covariance of its source. Readings of one meter
// and one kind of source share their error: more of them do not lower it, their scatter adds to it.
// Walls and ambient light tint what a meter sees: `others` (null: nothing but the lamp shone) says
// how much of each reading they are, and readings at several distances, behind the card or with the
// lamp off tell how (shared_color.h). `off_wall`: what a camera saw besides, on a wall. Where a
// chromaticity has no CCT that is withheld with the warning cct_withheld. FittedColor::meter has the
// sigma of its kind, what it repeats within included. Empty when no reading of the lamp holds
// colour.
[[nodiscard]] ColorFit FitColor(const Session& session, const LightDescription& light,
                                const OtherLight* others, Warnings& warnings,
                                CctMethod method = CctMethod::kExact,
                                const ColorOffWall* off_wall = nullptr);

}  // namespace lightcal::fit
