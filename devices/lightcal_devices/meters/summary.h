// SPDX-License-Identifier: Apache-2.0
// Several measurements of the same light -> the one to keep.
#pragma once

#include <optional>
#include <span>

#include "lightcal_devices/meters/meter.h"

namespace lightcal::devices {

struct Summary {
  MeterReading kept;
  int count = 0;
  double spread_relative = 0.0;  // 1 sigma of one measurement; 0 with fewer than two
};

// E = median of the E_i; colour and spectrum are those of the measurement nearest to it.
//   spread = 1.4826 median|E_i - E| / E        (1 sigma of a normal variable from its MAD), or
//            1.2533 mean|E_i - E| / E          where that is over twice as much and a quarter or
//                                              more of the E_i are over 2 % away: light that jumps
//   sigma  = max(sigma of the meter, spread)
// A measurement over range counts as brighter than all others, one under range as darker; when the
// median itself is one of them, the summary is that censored reading and has no spread.
// Warnings, besides those of the measurements (each code once):
//   drift    a trend of more than three of its own standard errors, and of more than 0.5 % of E
//            from first to last (four measurements or more)
//   flicker  no trend, but a spread above 2 % (five or more): mains or PWM flicker, or movement
// Holds for at least one measurement, each with an illuminance; absent otherwise.
[[nodiscard]] std::optional<Summary> Summarise(std::span<const MeterReading> measurements);

// Whether the last kSettleWindow values changed by less than `tolerance_relative` from first to
// last along their least-squares line. False with fewer values.
inline constexpr std::size_t kSettleWindow = 6;
[[nodiscard]] bool HasSettled(std::span<const double> illuminances_lx, double tolerance_relative);

}  // namespace lightcal::devices
