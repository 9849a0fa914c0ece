// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/sekonic/frame.h"

namespace lightcal::devices::sekonic {

inline constexpr double kSigmaRelative = 0.05;  // 1 sigma of E
inline constexpr double kLowestIlluminanceLx = 1.0;
inline constexpr double kHighestIlluminanceLx = 200000.0;
inline constexpr double kLowestColorLx = 5.0;

// What a measurement may be believed to say, by the meter's own ranges:
//   above 200000 lx     over_range is set and colour is absent
//   below 1 lx          under_range is set with 1 lx, and colour is absent
//   below 5 lx          colour, rendering and spectrum are absent, warning low_light_color
//   CCT                 absent outside 1563 .. 100000 K, beyond |Duv| 0.1, and at 50000 K exactly
//                       (what a C-800 writes for "over"), with the warning cct_out_of_range
// The self-checks of frame.h add their warnings. Never a number that is not finite.
[[nodiscard]] MeterReading ReadingFromMeasurement(const Measurement& measurement,
                                                  const std::string& device);

}  // namespace lightcal::devices::sekonic
