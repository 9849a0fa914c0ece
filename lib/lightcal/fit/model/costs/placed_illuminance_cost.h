// SPDX-License-Identifier: Apache-2.0
// A reading whose meter stood at a known place, the lamp at an unknown one.
#pragma once

#include <cmath>
#include <optional>

#include "lightcal/fit/locate/placed_model.h"

namespace lightcal::fit {

// The residuals of LogIlluminanceCost, LinearIlluminanceCost and CensoredIlluminanceCost, by the
// row's form, of the illuminance PlacedIlluminance. Undefined (false) where meter or lamp faces
// away, and for logarithms where the model is not above 0.
struct PlacedIlluminanceCost {
  const PlacedRow* row;
  const std::optional<Vec3>* aim;

  template <class T>
  bool operator()(const T* ln_intensity, const T* lamp, const T* ambient, const T* distance_offset,
                  T* residual) const {
    using std::log;
    T predicted;
    if (!PlacedIlluminance(*row, *aim, *ln_intensity, lamp, *ambient, *distance_offset,
                           &predicted)) {
      return false;
    }
    if (row->form == ReadingRow::Form::kLinear) {
      residual[0] = (row->measured - predicted) / row->sigma;
      return true;
    }
    if (!(predicted > T(0.0))) return false;
    residual[0] = (std::log(row->measured) - log(predicted)) / row->sigma;
    if (row->form == ReadingRow::Form::kCensored && !(residual[0] > T(0.0))) residual[0] = T(0.0);
    return true;
  }
};

}  // namespace lightcal::fit
