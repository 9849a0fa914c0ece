// SPDX-License-Identifier: Apache-2.0
// Many readings as few: what a lamp may be is first looked for among rows that each stand for all
// of a stretch of distances.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

// The estimation with the readings of each fifth of distance (a factor of 1.2) moved to their mean
// distance by the inverse square law and averaged there. Its optimum lies a part of a standard
// deviation beside that of all rows: a start, never an answer.
struct MergedRows {
  Estimation estimation;
  // Of the places that were merged, beside estimation.rows (0, 0 for one that stands alone): how
  // many more there are than one, and the sum of their squares about a line, over the variances
  // that their means have without the scatter of the walls' light.
  struct Spread {
    int more = 0;
    double squares = 0.0;
  };
  std::vector<Spread> spreads;
};

// Absent where that would not leave less than half of the rows.
[[nodiscard]] std::optional<MergedRows> Merge(const Estimation& estimation);

// LnEvidence (hypotheses.h) of all rows as the merged ones tell it, up to a constant that all
// hypotheses of one lamp share.
[[nodiscard]] double LnEvidence(const MergedRows& merged, const Theta& theta);

}  // namespace lightcal::fit
