// SPDX-License-Identifier: Apache-2.0
// Pairs of views -> every view's rotation, roughly, along the pairs that agree best.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/match_views.h"

namespace lightcal {

struct ViewTree {
  std::vector<CameraAxes> axes;   // in those of the view the tree grew from
  std::vector<TurnedPair> pairs;  // those whose rotations fit the tree's within 4 degrees
};

// Refused: views_do_not_overlap (a view no pair joins to the most).
[[nodiscard]] Result<ViewTree> TreeOfViews(std::span<const std::string> names,
                                           std::vector<TurnedPair> pairs);

}  // namespace lightcal
