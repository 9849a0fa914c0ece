// SPDX-License-Identifier: Apache-2.0
// Measured intensities as samples on the chart of directions, and how much of it they cover.
#pragma once

#include <vector>

#include "lightcal/fit/distribution/intensity_surface.h"
#include "lightcal/light/intensity_sample.h"
#include "lightcal/light/lamp_axes.h"

namespace lightcal::fit {

// Of the peak: directions darker than this count as if they had it, in weights and in residuals.
inline constexpr double kDarkDirection = 0.02;

// The samples in their order; one whose sigma_cd is not above 0 has the weight 0, any other
//   1 / (sigma^2 + (0.3 % max(I, kDarkDirection peak))^2)   [1/cd^2]
[[nodiscard]] std::vector<ChartSample> OnChart(const LampAxes& axes,
                                               const std::vector<IntensitySample>& samples,
                                               double peak_cd);

// Near the brightest, and not a speck: of the used samples one in two hundred is brighter. cd; 0
// where none is used.
[[nodiscard]] double RoughPeak(const std::vector<IntensitySample>& samples);

// Half angle, rad, of the widest cone whose rim has samples beyond it at every azimuth.
[[nodiscard]] double CoveredCone(const std::vector<ChartSample>& chart);

// Knots over the rectangle of the used samples, `intervals` over its longer side. At least two
// samples must be used, at different places.
[[nodiscard]] ChartGrid GridOver(const std::vector<ChartSample>& chart, int intervals);

}  // namespace lightcal::fit
