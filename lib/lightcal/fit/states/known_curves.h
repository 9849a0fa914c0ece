// SPDX-License-Identifier: Apache-2.0
// The curves through a lamp's states, found once for many states between them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "lightcal/fit/states/control_curve.h"

namespace lightcal::fit {

// The last curve of each target: another state of the same lamp mostly asks for the same.
class KnownCurves {
 public:
  const ControlCurve& Of(std::vector<ControlKind> kinds, CurveTarget target,
                         std::vector<CurvePoint> points) {
    std::optional<Known>& known = of_target_[static_cast<std::size_t>(target)];
    if (!known || known->kinds != kinds || known->points != points) {
      known.emplace(Known{kinds, points, {std::move(kinds), target, std::move(points)}});
    }
    return known->curve;
  }

 private:
  struct Known {
    std::vector<ControlKind> kinds;
    std::vector<CurvePoint> points;
    ControlCurve curve;
  };
  std::array<std::optional<Known>, 3> of_target_;
};

}  // namespace lightcal::fit
