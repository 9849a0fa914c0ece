// SPDX-License-Identifier: Apache-2.0
// What the channels of one camera answer to each wavelength.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// Relative sensitivities of the sensor behind its filters and lens, equally spaced, all finite and
// on one scale for the three channels (the camera's own raw balance).
struct CameraSensitivities {
  std::string camera;  // make and model
  double first_nm = 380.0, step_nm = 5.0;
  std::array<std::vector<double>, 3> channels;  // red, green, blue: equally many samples
};

// Reads the JSON of rawtoaces-data: header.manufacturer, header.model, spectral_data.index.main =
// ["R","G","B"] and spectral_data.data.main = {"380": [r, g, b], ...}. It covers 400-700 nm at
// least.
// Refused: bad_sensitivities (not that, or the wavelengths are not equally spaced).
[[nodiscard]] Result<CameraSensitivities> CameraSensitivitiesFromJson(std::string_view text,
                                                                      std::string_view where);

// Why these are no sensitivities (lengths, 400-700 nm not covered, a blind channel); empty where
// they are.
[[nodiscard]] std::string FaultOf(const CameraSensitivities& sensitivities);

}  // namespace lightcal
