// SPDX-License-Identifier: Apache-2.0
// The cameras whose sensitivities ship with lightcal (sample_data/camera_sensitivities).
#pragma once

#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/camera_sensitivities.h"

namespace lightcal {

// All of them, by name. Measured at the Academy and its partners: rawtoaces-data, Apache-2.0.
[[nodiscard]] const std::vector<CameraSensitivities>& KnownCameras();

// The one a person means: its name, or the only one that holds every word typed ("5d mark iv").
// Refused: unknown_camera (with the nearest), ambiguous_camera (lists them).
[[nodiscard]] Result<CameraSensitivities> KnownCamera(std::string_view words);

}  // namespace lightcal
