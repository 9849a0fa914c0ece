// SPDX-License-Identifier: Apache-2.0
// A positive reading of relative uncertainty sigma.
#pragma once

#include <cmath>

#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

//   r = (ln m - ln E)/sigma.   Holds for m > 0; undefined (false) where the model is not above 0.
struct LogIlluminanceCost {
  const ReadingRow* row;

  template <class T>
  bool operator()(const T* ln_intensity, const T* distance_offset, const T* ambient,
                  T* residual) const {
    using std::log;
    const T predicted = RowIlluminance(*row, *ln_intensity, *distance_offset, *ambient);
    if (!(predicted > T(0.0))) return false;
    residual[0] = (std::log(row->measured) - log(predicted)) / row->sigma;
    return true;
  }
};

}  // namespace lightcal::fit
