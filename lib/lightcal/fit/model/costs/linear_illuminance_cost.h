// SPDX-License-Identifier: Apache-2.0
// A reading of absolute uncertainty sigma: near or below zero after subtraction, or with the lamp
// off.
#pragma once

#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

//   r = (m - E)/sigma.   Holds for every finite m; keeps the sign of a negative difference.
struct LinearIlluminanceCost {
  const ReadingRow* row;

  template <class T>
  bool operator()(const T* ln_intensity, const T* distance_offset, const T* ambient,
                  T* residual) const {
    residual[0] =
        (row->measured - RowIlluminance(*row, *ln_intensity, *distance_offset, *ambient)) /
        row->sigma;
    return true;
  }
};

}  // namespace lightcal::fit
