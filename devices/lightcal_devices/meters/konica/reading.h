// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal_devices/meters/konica/frame.h"
#include "lightcal_devices/meters/meter.h"

namespace lightcal::devices::konica {

// 1 sigma of both models, beside one digit of the display; the makers' +-2 % taken as it stands.
inline constexpr double kSigmaRelative = 0.02;
// The tops of the highest ranges: what "over range" means in automatic range.
inline constexpr double kT10aHighestLx = 299900.0;
inline constexpr double kCl200aHighestLx = 99990.0;

// The answer to 10: illuminance, delta, per cent; the last two are not used. Fails: bad_reply where
// there is no illuminance.
[[nodiscard]] Result<MeterReading> ReadingFromT10a(const LongReply& ev, const std::string& device);

// The answers to 02 (Ev, x, y) and 08 (Ev, CCT, Duv) of one held measurement.
//   low luminance       illuminance alone, low_light_color
//   CCT out of range    xy alone, cct_out_of_range
// Warns self_check where the two do not tell the same illuminance. Fails as ReadingFromT10a.
[[nodiscard]] Result<MeterReading> ReadingFromCl200a(const LongReply& chromaticity,
                                                     const LongReply& temperature,
                                                     const std::string& device);

}  // namespace lightcal::devices::konica
