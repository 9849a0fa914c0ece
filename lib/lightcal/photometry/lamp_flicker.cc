// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/lamp_flicker.h"

#include <algorithm>
#include <cmath>

#include "lightcal/photometry/exposure_grid.h"

namespace lightcal {

double WorstFlickerError(const LampFlicker& lamp, Seconds time) {
  const double periods = lamp.frequency_hz * time.value();
  const double x = periods - std::floor(periods);
  const double d = lamp.duty;
  const double high = std::min(x, d) - x * d;
  const double low = x * d - std::max(0.0, x + d - 1.0);
  return std::max(high, low) / (periods * d);
}

std::vector<Seconds> FlickerSafeLabels(const LampFlicker& lamp, double tolerance,
                                       Seconds shortest) {
  std::vector<Seconds> safe;
  const int first = static_cast<int>(std::ceil(3.0 * std::log2(shortest.value()) - 1e-6));
  for (int thirds = first; thirds <= 0; ++thirds) {
    const Seconds time(std::exp2(thirds / 3.0));
    const auto label = LabelOfTime(time);
    if (label && WorstFlickerError(lamp, time) <= tolerance) safe.push_back(*label);
  }
  return safe;
}

}  // namespace lightcal
