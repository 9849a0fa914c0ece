// SPDX-License-Identifier: Apache-2.0
// What hand-held lux meters have in common: they send the number on their display.
#pragma once

#include <string>
#include <string_view>

#include "lightcal_devices/meters/meter.h"

namespace lightcal::devices {

// counts 10^-decimals, in lx or fc: 1234 counts of one decimal are 123.4, of -2 decimals 123400.
struct DisplayedIlluminance {
  int counts = 0;  // >= 0
  int decimals = 0;
  bool footcandles = false;
};

// The displayed value in lx; the decimal number itself (123.4, not 123.40000000000001) when the
// display is in lx.   1 fc = 1 lm/ft^2 = 10.7639 lx.
[[nodiscard]] double LuxFromDisplay(const DisplayedIlluminance& displayed);

// The relative 1 sigma of a displayed value E whose last digit is worth q, rounding being uniform:
//   sigma = hypot(instrument, q / (sqrt(12) E)), 0.99 at most, which stands for "hardly known".
[[nodiscard]] double SigmaOfDisplay(const DisplayedIlluminance& displayed,
                                    double instrument_sigma_relative);

// What a lux meter is good for.
struct DisplayLimits {
  double sigma_relative = 0.0;  // 1 sigma of the instrument, without the display's digit
  double highest_lx = 0.0;      // where its highest range ends
};

// A photometer's reading; one above `highest_lx` is over range, at highest_lx, and a display of 0
// is under range, at one digit.
[[nodiscard]] MeterReading ReadingFromDisplay(const DisplayedIlluminance& displayed,
                                              const DisplayLimits& limits,
                                              const std::string& device);
// A reading whose true value is only known to be at least `limit_lx`.
[[nodiscard]] MeterReading OverRangeReading(double limit_lx, const DisplayLimits& limits,
                                            const std::string& device);

// What such meters have in common besides.
[[nodiscard]] Warning BatteryLow(const std::string& device);
[[nodiscard]] tl::unexpected<Error> NegativeReading(const std::string& device);
// "hold": the display shows HOLD, MAX or the like (`what`), which is not of now.
[[nodiscard]] tl::unexpected<Error> FrozenDisplay(std::string_view what, const std::string& device);

}  // namespace lightcal::devices
