// SPDX-License-Identifier: Apache-2.0
// A grey ball or card that stood where the dome was taken, in a plate -> the dome's scale.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/dome_input.h"

namespace lightcal {

// What grey balls and cards are sold as (1 sigma).
inline constexpr double kGreyReflectance = 0.18, kGreyReflectanceSd = 0.006;

struct GreyTarget {
  std::string file;             // the plate, for messages
  std::array<double, 4> box{};  // x, y, width, height: round the ball's outline, on the card
  bool ball = true;
  std::optional<Vec3> card_normal;  // of the sphere; absent: the card faces the camera
  ViewAim aim;                      // of the plate's camera
  std::optional<Radians>
      field_of_view;  // of its lens, across the width; absent: it looks at the box
  double reflectance = kGreyReflectance, reflectance_sd = kGreyReflectanceSd;
};

struct GreyScale {
  double factor = 1.0;       // what the dome's luminances are to be multiplied by
  double sd_relative = 0.0;  // of it, beside the plate's own scale
  double misfit_sd = 0.0;  // of ln L over the ball, robust: how well the dome explains its shading
  int cells = 0;           // places compared
};

// L = reflectance / pi E(n), with E of the whole dome on the surface's normal n (Lambert), compared
// in cells over the ball out to .9 of its outline. The factor is the mean of their ratios under
// Cauchy's loss; its sd is their scatter as six independent parts of the sphere would have it, the
// reflectance's, and half of what the dome's hole takes of E. Cells that face a hole for more than
// 3 % are left out.
// Refused: bad_ball (box), bad_region, grey_beyond_view (what the dome hides lights most of it),
// grey_black (no light on it), grey_disagrees (scatter beyond 25 %).
[[nodiscard]] Result<GreyScale> ScaleByGrey(const GreyTarget& target, View2d<const float> plate,
                                            const DomeInput& dome);

}  // namespace lightcal
