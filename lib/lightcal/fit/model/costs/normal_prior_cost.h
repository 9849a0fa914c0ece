// SPDX-License-Identifier: Apache-2.0
// What is known of one parameter before any reading.
#pragma once

namespace lightcal::fit {

//   r = (x - mean)/sd.
struct NormalPriorCost {
  double mean = 0.0;
  double sd = 1.0;

  template <class T>
  bool operator()(const T* value, T* residual) const {
    residual[0] = (*value - mean) / sd;
    return true;
  }
};

}  // namespace lightcal::fit
