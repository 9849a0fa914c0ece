// SPDX-License-Identifier: Apache-2.0
// The calibration factors of a person's meters.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/meter_calibration.h"
#include "lightcal/records/reading.h"
#include "lightcal/records/sources.h"

namespace lightcal {

class MeterCalibrations {
 public:
  // meters.toml of these directories, where there is one; what the first says of a meter counts.
  // Refused: bad_meters.
  [[nodiscard]] static Result<MeterCalibrations> Load(const std::vector<std::string>& directories,
                                                      const Sources& sources);

  // Multiplies the illuminance (and its limit, out of range) by the factor of reading.device and
  // notes it in calibration_factor. Warns: calibration_old (more than a year before the reading),
  // uncalibrated (a bare sensor without a factor).
  void Apply(Reading& reading, Warnings& warnings) const;

 private:
  std::vector<MeterCalibration> calibrations_;  // the first counts
};

}  // namespace lightcal
