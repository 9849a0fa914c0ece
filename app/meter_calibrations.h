// SPDX-License-Identifier: Apache-2.0
// The calibration factors of a person's meters, found beside the session and in their settings.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/meter_calibration.h"
#include "lightcal/records/reading.h"

namespace lightcal::app {

class MeterCalibrations {
 public:
  // meters.toml of the session's directory ("" = no session) and of $XDG_CONFIG_HOME/lightcal
  // (~/.config/lightcal where that is not set); what the session says of a meter counts first.
  // Refused: bad_meters.
  [[nodiscard]] static Result<MeterCalibrations> Load(const std::string& session_path);

  // Multiplies the illuminance (and its limit, out of range) by the factor of reading.device and
  // notes it in calibration_factor. Warns: calibration_old (more than a year before the reading),
  // uncalibrated (a bare sensor without a factor).
  void Apply(Reading& reading, Warnings& warnings) const;

 private:
  std::vector<MeterCalibration> calibrations_;  // the session's first
};

}  // namespace lightcal::app
