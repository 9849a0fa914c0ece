// SPDX-License-Identifier: Apache-2.0
// What an observation says wherever its meter stands, in the solver's units.
#pragma once

#include <cstddef>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

// Relative sigma from which the logarithm of a reading is no longer normal.
inline constexpr double kLinearBeyondSigma = 0.3;

// 1 sigma of what a card hides besides the direct light, of all that it leaves: in traced rooms 3
// to 5 % for cards of a lamp's size half way (tests/tools/traced_rooms).
inline constexpr double kCardHides = 0.04;

// Fills measured, sigma, form, ambient_gain and, of a lit row, bounce: Row is ReadingRow or
// PlacedRow. `i` is the observation's place among all (the model's bounce lies beside them).
template <class Row>
void FillRowValues(const Observation& o, std::size_t i, const ForwardModel& model, double length_m,
                   double lux, Row& row) {
  row.measured = o.measured_lx / lux;
  row.sigma = o.sigma_lx / lux;
  row.form = ReadingRow::Form::kLinear;
  row.ambient_gain = o.differenced || o.ambient_subtracted ? 0.0 : 1.0;
  if (!o.lit) return;
  if (!o.differenced && i < model.bounce_per_candela.size()) {
    row.bounce = model.bounce_per_candela[i] * length_m * length_m;
  }
  if (!(o.measured_lx > 0.0)) return;
  const double relative = o.sigma_lx / o.measured_lx;
  if (relative < kLinearBeyondSigma) {
    row.form = o.over_range ? ReadingRow::Form::kCensored : ReadingRow::Form::kLog;
    row.sigma = relative;
  }
}

}  // namespace lightcal::fit
