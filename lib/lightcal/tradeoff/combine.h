// SPDX-License-Identifier: Apache-2.0
// Which combinations of knobs are worth measuring, foretold from each knob's own change.
#pragma once

#include <cstddef>
#include <vector>

namespace lightcal::tradeoff {

// What one level of one knob changes against the usual profile.
struct Change {
  std::size_t level = 0;
  double seconds = 0.0;             // added
  std::vector<double> differences;  // added to each figure's signed difference
};

struct Foretold {
  std::vector<std::size_t> levels;  // of each knob
  double seconds = 0.0;
  std::vector<double> differences;
  double worst = 0.0;  // largest |difference|/limit: allowed up to 1
};

struct CombineInput {
  std::vector<std::size_t> usual;            // levels
  double seconds = 0.0;                      // of the usual profile
  std::vector<double> differences;           // of the usual profile
  std::vector<double> limits;                // of each figure, above 0
  std::vector<std::vector<Change>> changes;  // of each knob; empty where it is not in play
  double budget = 0.0;                       // seconds; 0 = none
};

// The `count` best by adding changes up: the cheapest with worst <= 1, or under a budget the most
// accurate within it; then, where fewer are found, those that come nearest. A beam over the knobs,
// wide enough to hold every combination of seven knobs with three levels.
[[nodiscard]] std::vector<Foretold> BestCombinations(const CombineInput& input, std::size_t count);

}  // namespace lightcal::tradeoff
