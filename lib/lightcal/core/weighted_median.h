// SPDX-License-Identifier: Apache-2.0
// The middle of values that count by their weights.
#pragma once

#include <algorithm>
#include <vector>

namespace lightcal {

struct WeightedValue {
  double value = 0.0;
  double weight = 0.0;
};

// The least value up to which half of all weight lies. `values` is sorted by it, and not empty.
[[nodiscard]] inline double WeightedMedian(std::vector<WeightedValue>& values) {
  std::ranges::sort(values, {}, &WeightedValue::value);
  double total = 0.0;
  for (const WeightedValue& v : values) total += v.weight;
  double sum = 0.0;
  for (const WeightedValue& v : values) {
    sum += v.weight;
    if (sum >= 0.5 * total) return v.value;
  }
  return values.back().value;
}

}  // namespace lightcal
