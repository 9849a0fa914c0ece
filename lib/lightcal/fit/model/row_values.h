// SPDX-License-Identifier: Apache-2.0
// What an observation says wherever its meter stands, in the solver's units.
#pragma once

#include <algorithm>
#include <cmath>
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
// The same of other light, which comes from everywhere: a card half way to a lamp of radius r at
// distance d covers (2 r / d)^2 of it, one in a hundred where r is a twentieth of d.
inline constexpr double kCardHidesOther = 0.01;

// Whether the light from the walls is in that row: of one with the lamp unless a card's reading was
// subtracted, of one without it if it was read behind a card.
[[nodiscard]] inline bool SeesWalls(const Observation& observation, bool lit_row) {
  return observation.sees_walls && (lit_row ? !observation.differenced : observation.behind_card);
}

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
  // What a distance is off by has a logarithm however large it is.
  const double read = std::sqrt(std::max(0.0, relative * relative - o.by_distance * o.by_distance));
  if (read < kLinearBeyondSigma) {
    row.form = o.over_range ? ReadingRow::Form::kCensored : ReadingRow::Form::kLog;
    row.sigma = relative;
  }
}

// 1 sigma of what the card that was subtracted hides besides the direct light. `hides`: of the
// walls' light that it leaves.
[[nodiscard]] inline double HiddenByCard_lx(const Observation& observation, double hides) {
  const double other_lx = std::clamp(observation.card_other_lx, 0.0, observation.card_lx);
  return std::hypot(hides * (observation.card_lx - other_lx), kCardHidesOther * other_lx);
}

// What was read behind the card that was subtracted: the walls' light, without the lamp's own, and
// other light where nothing takes that away.
[[nodiscard]] inline Observation BehindCard(const Observation& observation) {
  Observation card = observation;
  card.lit = true;
  card.differenced = false;
  card.measured_lx = LeftByCard_lx(observation);
  card.sigma_lx = std::hypot(observation.card_sigma_lx, HiddenByCard_lx(observation, kCardHides));
  return card;
}

// A card before the lamp hides some of the walls too: what was subtracted lacks it. `hides`: 1
// sigma, of the walls' light that the card left.
template <class Row>
void WidenByCard(const Observation& observation, double hides, double lux, Row& row) {
  const double hidden = HiddenByCard_lx(observation, hides) / lux;
  const double unit = row.form == RowForm::kLinear ? 1.0 : row.measured;
  row.sigma = row.own_sigma = std::hypot(row.sigma, hidden / unit);
}

}  // namespace lightcal::fit
