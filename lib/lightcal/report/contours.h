// SPDX-License-Identifier: Apache-2.0
// Lines of equal value through a field of samples.
#pragma once

#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/report/svg.h"

namespace lightcal::report {

// A line in sample coordinates: (0, 0) is the middle of the first sample. Closed lines end where
// they begin.
using Contour = std::vector<PagePoint>;

// Where the bilinear field crosses `level`: marching squares, saddles parted by the mean of their
// corners, pieces joined. Longest first.
// Source: Lorensen & Cline, Marching Cubes (1987), in two dimensions.
[[nodiscard]] std::vector<Contour> ContoursOf(View2d<const float> field, double level);

// Means of blocks, so that neither side exceeds `most`; block = the side of one.
struct ReducedField {
  std::vector<float> samples;
  int width = 0, height = 0, block = 1;
  [[nodiscard]] View2d<const float> view() const { return {samples.data(), width, height}; }
};
[[nodiscard]] ReducedField Reduce(View2d<const float> field, int most);

}  // namespace lightcal::report
