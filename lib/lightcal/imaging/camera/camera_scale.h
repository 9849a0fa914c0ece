// SPDX-License-Identifier: Apache-2.0
// Readings of luminance -> the constant of one camera's absolute scale.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/camera_profile.h"

namespace lightcal {

// One reading with its error in two parts.
struct WeighedScaleReading {
  ScaleReading reading;  // sigma_relative is set from the two below
  std::string meter;     // readings of one meter share meter_sd; "" = the unnamed one
  double meter_sd = 0.0, own_sd = 0.0;  // relative
};

// Mean of ln k, each weighted by 1/(meter_sd^2 + own_sd^2); the meter's part does not shrink by
// reading more with it. Readings that disagree beyond the 95 % point of chi-square widen the result
// by sqrt(chi^2/dof) and are warned of (scale_readings_disagree).
// Refused: no_readings.
[[nodiscard]] Result<CameraScale> CombineScaleReadings(
    std::span<const WeighedScaleReading> readings, Warnings& warnings);

// What the scale is worth at another aperture or ISO speed than it was read at, 1 sigma, relative:
// 2 % more for each. Apertures repeat within 5 % and drift by 1.4 % from f/5.6 to f/11 beyond their
// labels (capture reference, 6); ISO steps are rounded to 0.8 %, amplifiers add theirs.
[[nodiscard]] double ScaleSigmaAt(const CameraScale& scale, std::optional<double> f_number,
                                  std::optional<double> iso);

}  // namespace lightcal
