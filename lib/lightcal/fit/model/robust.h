// SPDX-License-Identifier: Apache-2.0
// The estimate when some readings may be wrong.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

struct RobustEstimate {
  Theta theta{};
  Estimation kept;              // the rows that carried it
  std::vector<int> rejected;    // positions in the rows given
  std::vector<int> suspicious;  // four readings or fewer: far from the model, yet none is rejected
  bool bimodal = false;         // two of four disagree with the other two
  // Of the one rejected row that alone asked for an offset which its prior does not allow, that
  // offset in metres.
  std::optional<double> offset_of_one_m{};
};

// Squared loss when no residual exceeds kSuspiciousResidual. Otherwise, by the number n of readings
// with the lamp on: n <= 3 none is rejected; n = 4 median start and Huber loss, none is rejected; n
// >= 5 median start, Huber, then Tukey polish with the scale max(1, 1.4826 MAD); readings beyond
// kTukeyConstant scales are rejected and the estimate is the squared-loss one on those kept.
// `squared`: the squared-loss optimum, where the caller knows it. Fails as Solve.
[[nodiscard]] Result<RobustEstimate> EstimateRobustly(const Estimation& estimation,
                                                      const Theta* squared = nullptr);
// The rows without those at the ascending positions `rejected`.
[[nodiscard]] std::vector<ReadingRow> Without(const std::vector<ReadingRow>& rows,
                                              const std::vector<int>& rejected);

inline constexpr double kSuspiciousResidual = 2.5;

}  // namespace lightcal::fit
