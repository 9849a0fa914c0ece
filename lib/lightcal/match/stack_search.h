// SPDX-License-Identifier: Apache-2.0
// The stacks of gels whose colour comes nearest, out of all there are.
#pragma once

#include <cstddef>
#include <vector>

#include "lightcal/match/match_scene.h"

namespace lightcal::match {

// Of the time that matching takes, in the middle; the rest goes into intervals.
inline constexpr double kSearchShare = 0.8;

struct RankedStack {
  std::vector<std::size_t> gels;
  double difference = 0.0;  // the camera's, the median of many cameras', else the observer's
};

struct StackSearch {
  std::vector<RankedStack> best;        // the `count` nearest, nearest first
  std::size_t stacks = 0;               // all there are, none among them
  std::vector<std::size_t> nearest_uv;  // of all, in u'v'
  double least_delta_uv = 0.0;
};
// Exhaustive: a stack is left early only when it must be farther than `count` others.
[[nodiscard]] StackSearch FindNearestStacks(const MatchScene& scene, std::size_t count);

// The difference that decides.
[[nodiscard]] double DecidingDifference(const MatchScene& scene, const NodeValues& transmittance);

}  // namespace lightcal::match
