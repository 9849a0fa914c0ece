// SPDX-License-Identifier: Apache-2.0
// Luminous intensity measured in one direction.
#pragma once

#include "lightcal/core/vec3.h"

namespace lightcal {

struct IntensitySample {
  Vec3 direction{};  // unit length, away from the lamp, in the frame of its position
  double intensity_cd = 0.0;
  double sigma_cd = 0.0;  // 1 sigma of what differs from sample to sample
};

}  // namespace lightcal
