// SPDX-License-Identifier: Apache-2.0
// A reading of a meter that was over its range: the truth is at least the number shown.
#pragma once

#include "lightcal/fit/model/costs/log_illuminance_cost.h"
#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

//   r = max(0, ln m - ln E)/sigma: nothing is asked of a model brighter than the meter's end.
struct CensoredIlluminanceCost {
  const ReadingRow* row;

  template <class T>
  bool operator()(const T* ln_intensity, const T* distance_offset, const T* ambient,
                  T* residual) const {
    const LogIlluminanceCost shortfall{row};
    if (!shortfall(ln_intensity, distance_offset, ambient, residual)) return false;
    if (!(residual[0] > T(0.0))) residual[0] = T(0.0);
    return true;
  }
};

}  // namespace lightcal::fit
