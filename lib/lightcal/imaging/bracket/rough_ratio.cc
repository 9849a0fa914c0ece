// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/rough_ratio.h"

#include <algorithm>
#include <vector>

namespace lightcal {
namespace {

// Where most numbers lie: the middle of the shortest interval that holds a quarter of them. Half of
// a picture that moved does not reach it, as it does the median.
float Densest(std::vector<float>& values) {
  constexpr std::size_t kEnough = 20'000;
  const std::size_t step = values.size() / kEnough + 1;
  std::vector<float> some;
  for (std::size_t i = 0; i < values.size(); i += step) some.push_back(values[i]);
  std::ranges::sort(some);
  const std::size_t quarter = some.size() / 4;
  std::size_t best = 0;
  for (std::size_t i = 0; i + quarter < some.size(); ++i) {
    // As a ratio: what is rare is spread over all of them.
    if (some[i + quarter] * some[best] < some[best + quarter] * some[i]) best = i;
  }
  return some[best + quarter / 2];
}

}  // namespace

std::optional<double> RoughRatio(std::span<const float> a, std::span<const float> b,
                                 std::span<const float> clip) {
  for (const float floor : {0.03F, 0.01F, 0.003F, 0.001F}) {
    std::vector<float> ratios;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool clear = a[i] > floor * clip[i] && b[i] > floor * clip[i] &&
                         a[i] < 0.9F * clip[i] && b[i] < 0.9F * clip[i];
      if (clear) ratios.push_back(b[i] / a[i]);
    }
    if (static_cast<double>(ratios.size()) < kLeastSharedSamples) continue;
    return Densest(ratios);
  }
  return std::nullopt;
}

}  // namespace lightcal
