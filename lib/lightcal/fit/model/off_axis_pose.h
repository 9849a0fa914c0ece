// SPDX-License-Identifier: Apache-2.0
// One meter before a source with size and aim.
#pragma once

#include <cmath>
#include <cstdint>

#include "lightcal/light/models/source_model.h"

namespace lightcal::fit {

struct PlacedSource {
  SourceModel model;
  Vec3 position_m{};
  SourceFrame frame;
};

// How a distance offset moves the effective source: against its aim, straight away from the meter,
// or away from it square to the axis.
enum class OffsetWay : std::uint8_t { kAgainstAim, kAway, kAwayFromAxis };

struct OffAxisPose {
  SourceModel source;
  Receiver<double> at;  // in the source's frame and the unit of its sizes
  OffsetWay way = OffsetWay::kAgainstAim;
};

// E/I with the source moved by d0.   T is double or an automatic-differentiation scalar.
template <class T>
[[nodiscard]] T LuxPerCandela(const OffAxisPose& pose, const T& d0) {
  const Vec3& p = pose.at.position;
  Receiver<T> at{{T(p[0]), T(p[1]), T(p[2])},
                 {T(pose.at.normal[0]), T(pose.at.normal[1]), T(pose.at.normal[2])}};
  switch (pose.way) {
    case OffsetWay::kAgainstAim:
      at.position[2] += d0;
      break;
    case OffsetWay::kAway: {
      const T stretch = 1.0 + d0 / Length(p);
      at.position = at.position * stretch;
      break;
    }
    case OffsetWay::kAwayFromAxis: {
      const double away = std::hypot(p[1], p[2]);
      if (!(away > 0.0)) break;
      const T stretch = 1.0 + d0 / away;
      at.position[1] = at.position[1] * stretch;
      at.position[2] = at.position[2] * stretch;
      break;
    }
  }
  return LuxPerCandela(pose.source, at);
}

}  // namespace lightcal::fit
