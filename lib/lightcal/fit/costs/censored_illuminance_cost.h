// SPDX-License-Identifier: Apache-2.0
// A reading of a meter that was over its range: the truth is at least the number shown.
#pragma once

#include <cmath>

#include "lightcal/fit/reading_model.h"

namespace lightcal::fit {

//   r = max(0, ln m - ln E)/sigma: nothing is asked of a model brighter than the meter's end.
struct CensoredIlluminanceCost {
  const ReadingRow* row;

  template <class T>
  bool operator()(const T* ln_intensity, const T* distance_offset, const T* ambient,
                  T* residual) const {
    using std::log;
    const T predicted = RowIlluminance(*row, *ln_intensity, *distance_offset, *ambient);
    if (!(predicted > T(0.0))) return false;
    const T shortfall = (std::log(row->measured) - log(predicted)) / row->sigma;
    residual[0] = shortfall > T(0.0) ? shortfall : T(0.0);
    return true;
  }
};

}  // namespace lightcal::fit
