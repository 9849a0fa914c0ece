// SPDX-License-Identifier: Apache-2.0
// The figures of one light, as SVG text; empty where the light has nothing to show.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/fitted_light.h"

namespace lightcal::report {

// Illuminance against distance, both logarithmic: the model, its 95 % band, readings with their own
// 95 % interval. A reading is shown at E(d) (1 + residual), which is what a facing meter would
// have read of the lamp alone, without its walls' light. id must be unique in the page.
[[nodiscard]] std::string DistanceFigure(const FittedLight& light, std::string_view id);

// E d^2 against distance, both linear: readings with their own 95 % interval, the flat band of the
// lamp's intensity, and above it the wedge of what walls add; behind a shadow card a reading stands
// on the band. "" where no reading has a distance.
[[nodiscard]] std::string RoomFigure(const FittedLight& light, std::string_view id);

// (measured/model - 1) in percent against distance, with 95 % intervals of the readings. Rejected
// readings beyond the axis are drawn at its edge with their value.
[[nodiscard]] std::string ResidualFigure(const FittedLight& light, std::string_view id);

// Polar diagram of a measured distribution, as PolarPlot draws it.
[[nodiscard]] std::string PolarFigure(const FittedLight& light, std::string_view id);

// CIE 1976 u'v' around the light's chromaticity: Planckian locus, isotherms with their CCT, lines
// of Duv +-0.006, the point and its 95 % ellipse.
[[nodiscard]] std::string ChromaticityFigure(const FittedLight& light, std::string_view id);

}  // namespace lightcal::report
