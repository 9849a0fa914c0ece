// SPDX-License-Identifier: Apache-2.0
// meters.toml: what a person knows about their own meters.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// The result of comparing one meter with a better one: true illuminance = factor x shown.
struct MeterCalibration {
  std::string device;                    // the id of a found meter: "sekonic:J0123"
  double factor = 1.0;                   // > 0
  std::string date;                      // "2026-03-01", "" = unknown
  std::optional<double> sigma_relative;  // 1 sigma of the corrected reading; replaces the driver's
};

// The file:
//   lightcal = 1
//   [[calibration]]
//   device = "hid_als:1-1.4"
//   factor = 1.13
//   date = 2026-03-01
//   sigma_relative = 0.03
// Refused: bad_meters, unknown_key, with file and line; a device named twice; a factor outside
// 0.01 to 100.
[[nodiscard]] Result<std::vector<MeterCalibration>> MeterCalibrationsFromToml(
    std::string_view text, std::string_view where);

}  // namespace lightcal
