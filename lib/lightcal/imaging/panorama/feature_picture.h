// SPDX-License-Identifier: Apache-2.0
// A view as features are looked for in it: what its exposure, its lens's fall-off and its
// projection make of a thing changes little there.
#pragma once

#include <cstdint>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/panorama.h"
#include "lightcal/records/picture_feature.h"

namespace lightcal {

struct FeaturePicture {
  int width = 0, height = 0;
  double pixels_per_radian = 1.0;  // in the middle
  std::vector<std::uint8_t> grey;  // ln L over its local mean and spread
  std::vector<std::uint8_t> seen;  // 0: no part of the view

  // The direction (right, forward, up) through a point, pixel centres at .5.
  [[nodiscard]] Vec3 DirectionOf(double x, double y) const;
};

// Stereographic, rho = 2 tan(theta/2): circles stay circles, so that what lies at the rim of one
// view looks as in the middle of another, but for its size. `longest` pixels at most a side, and
// none smaller than the view's own.
[[nodiscard]] FeaturePicture MakeFeaturePicture(View2d<const float> nits,
                                                const PixelSolidAngles& angles, int longest);

// Features found there, at their places in the view's own picture; those beyond it are left out.
[[nodiscard]] std::vector<PictureFeature> FeaturesInView(std::vector<PictureFeature> features,
                                                         const FeaturePicture& picture,
                                                         const PixelSolidAngles& angles);

}  // namespace lightcal
