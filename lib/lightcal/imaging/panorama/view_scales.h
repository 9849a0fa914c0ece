// SPDX-License-Identifier: Apache-2.0
// Pictures of one place that overlap -> one scale for all of them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/view_contradictions.h"

namespace lightcal {

// With f a view's factor, L = f sample / exp(v(r)) is one luminance in every view that shows a
// direction; r is RimShare, v(r) = falloff . (r^2, r^4, r^6) what the one lens loses towards its
// rim (none for kLatLong).
struct ViewScales {
  std::vector<double> factor;
  std::vector<double> sd_relative;  // of factor, as a deviation from the gauge
  std::array<double, 3> falloff{};
  double agreement_sd = 0.0;  // robust sd of ln L of a view, by pairs of one direction
  std::vector<ViewOverlap> overlaps;

  [[nodiscard]] double Falloff(double rim_share) const;  // exp(v(r))
};

// Least squares of ln L over cells of 2 degrees that two views and more show lit and unclipped,
// each weighted by its scatter, by pairs under Cauchy's loss: people who moved and reflections
// count little. The lens's fall-off is solved with the factors. sd by the scatter of blocks of 12
// degrees, inside which errors are taken to be one (sandwich estimator), and 0.015 % for sampling
// between pixels. Gauge: the factors' product is 1 over the views that `in_gauge` marks, so that
// the error of n labels becomes 1/sqrt(n) of one; empty: over all. Refused: views_do_not_overlap (a
// view shares too little with the others), naming the view.
[[nodiscard]] Result<ViewScales> SolveViewScales(std::span<const AimedPicture> views,
                                                 const std::vector<bool>& in_gauge = {});

}  // namespace lightcal
