// SPDX-License-Identifier: Apache-2.0
// Pairs of a bracket's frames, compared level by level.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/imaging/bracket/light_changes.h"
#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {

inline constexpr double kBelievedTo = 0.8;  // of the clip, when ratios are summed

struct PairRatio {
  std::size_t a = 0, b = 0;
  double ln_ratio = 0.0, sd = 0.0;
  bool clip_known = true;
  PairSums sums{};
  std::optional<RatioRange> regions{};  // where they disagree
};

// Sums over the levels between the two.
[[nodiscard]] LevelSums SumLevels(const PairSums& sums, double from, double to);

// The brightest range, up to `to`, that tells the ratio: there black levels matter least.
[[nodiscard]] std::optional<LevelSums> TellingLevels(const PairSums& sums, double to);

// Every pair of neighbours and of next neighbours in exposure that tells something; `order`:
// frames by their label.
[[nodiscard]] std::vector<PairRatio> MeasurePairs(const SampledSignals& signals,
                                                  std::span<const std::size_t> order);

// The level, .5 to .9 of the clip, from which longer frames fall behind what shorter ones
// predict, over all pairs: by .1 % and four standard deviations beyond the straight line through
// the levels below, which need not meet the origin (black levels are off). Where nobody knows the
// clip there is no level.
[[nodiscard]] double LinearTo(std::span<const PairRatio> pairs);

}  // namespace lightcal
