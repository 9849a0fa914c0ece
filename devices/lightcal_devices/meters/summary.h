// SPDX-License-Identifier: Apache-2.0
// Several measurements of the same light -> the one to keep.
#pragma once

#include <optional>
#include <span>

#include "lightcal_devices/meters/meter.h"

namespace lightcal {

struct Summary {
  MeterReading kept;
  int count = 0;
  double spread_relative = 0.0;  // 1 sigma of one measurement; 0 with fewer than two
};

// E = median of the E_i; colour and spectrum are those of the measurement nearest to it.
//   spread = 1.4826 median|E_i - E| / E        (1 sigma of a normal variable from its MAD)
//   sigma  = max(sigma of the meter, spread)
// A trend over the series of more than three of its own standard errors, and of more than 0.5 % of
// E from first to last, is the warning drift. Warnings of the measurements are kept, each code
// once. Holds for at least one measurement, each with an illuminance; absent otherwise.
[[nodiscard]] std::optional<Summary> Summarise(std::span<const MeterReading> measurements);

}  // namespace lightcal
