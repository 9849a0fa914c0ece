// SPDX-License-Identifier: Apache-2.0
// The curves through a lamp's states, found once for many states between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "lightcal/fit/states/control_curve.h"

namespace lightcal::fit {

// The last curves of each target: another state of the same lamp mostly asks for one of them.
class KnownCurves {
 public:
  // Valid until the next call.
  const ControlCurve& Of(std::vector<ControlKind> kinds, CurveTarget target,
                         std::vector<CurvePoint> points) {
    std::vector<Known>& known = of_target_[static_cast<std::size_t>(target)];
    const auto found = std::ranges::find_if(
        known, [&](const Known& one) { return one.kinds == kinds && one.points == points; });
    if (found != known.end()) {
      std::rotate(known.begin(), found, found + 1);
    } else {
      if (known.size() == kMostKnown) known.pop_back();
      known.insert(known.begin(),
                   Known{kinds, points, {std::move(kinds), target, std::move(points)}});
    }
    return known.front().curve;
  }

 private:
  // A curve of 30 points takes some megabytes; a search goes back and forth between few.
  static constexpr std::size_t kMostKnown = 6;

  struct Known {
    std::vector<ControlKind> kinds;
    std::vector<CurvePoint> points;
    ControlCurve curve;
  };
  std::array<std::vector<Known>, 3> of_target_;  // the last asked for first
};

}  // namespace lightcal::fit
