// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal {

Steradians SolidAngleOfCone(Radians half_angle) {
  const double s = std::sin(half_angle.value() / 2.0);
  return Steradians(4.0 * std::numbers::pi * s * s);
}

Radians ConeHalfAngleFromSolidAngle(Steradians solid_angle) {
  const double s2 = std::clamp(solid_angle.value() / (4.0 * std::numbers::pi), 0.0, 1.0);
  return Radians(2.0 * std::asin(std::sqrt(s2)));
}

Steradians SolidAngleOfZone(Radians inner, Radians outer) {
  const double sum = (inner + outer).value() / 2.0;
  const double difference = (outer - inner).value() / 2.0;
  return Steradians(4.0 * std::numbers::pi * std::sin(sum) * std::sin(difference));
}

}  // namespace lightcal
