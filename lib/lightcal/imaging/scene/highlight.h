// SPDX-License-Identifier: Apache-2.0
// The brightest spot on a mirror ball.
#pragma once

#include <array>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"

namespace lightcal {

struct Highlight {
  std::array<double, 2> point{};  // centroid, pixel centres at .5
  bool alone = true;              // no other spot is nearly as bright
};

// values: the box around the ball's outline, any unit, one channel; x and y of the answer count
// from its corner. The spot are the pixels around the brightest one above half way from the median
// to it, of means of 2 x 2 (so that colour filters count alike), inside the ellipse that fills the
// box. Refused: no_highlight (nothing stands out, or what does fills a tenth of the ball); `name`
// stands in messages.
[[nodiscard]] Result<Highlight> FindHighlight(View2d<const float> values, const std::string& name);

}  // namespace lightcal
