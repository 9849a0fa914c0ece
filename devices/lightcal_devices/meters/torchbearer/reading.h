// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/torchbearer/frame.h"

namespace lightcal::devices::torchbearer {

// 1 sigma of E: nobody has compared one with a reference for us.
inline constexpr double kSigmaRelative = 0.10;

// Of a measurement whose exposure was right.
//   E = 683.002 lm/W sum E_lambda V dl; xy, CCT and Duv of the same spectrum (colorimetry/).
// A spectrum without any light in it reads 0 lx and has no colour; CCT is absent where the light is
// no white, with the warning cct_out_of_range. Every reading warns experimental; spectrum_range
// when the spectrum does not reach over 380-780 nm.
[[nodiscard]] MeterReading ReadingFromMeasurement(const Measurement& measurement,
                                                  const WavelengthRange& range,
                                                  const std::string& device);

}  // namespace lightcal::devices::torchbearer
