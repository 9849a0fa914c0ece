// SPDX-License-Identifier: Apache-2.0
// Where two views of one direction show what cannot be one place.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/overlap_cells.h"

namespace lightcal {

// What two views say of the cells that both show, on one scale. Contradicting: neither shows within
// 6 degrees what the other does, give or take 10 %, which neither near things seen from two places
// nor an aim that is a little off explains.
struct ViewOverlap {
  std::size_t a = 0, b = 0;
  double area = 0.0;           // in cells of the equator
  double apart = 0.0;          // share of it that differs by more than 10 %
  double contradicting = 0.0;  // share of it
  double unmatched = 0.0;      // share in which one of both shows not what the other does
};

// Every pair that shares a cell. values[view][cell]: ln of luminance on the common scale, NaN where
// the view shows nothing whole, infinite where it is clipped.
[[nodiscard]] std::vector<ViewOverlap> OverlapsOf(const std::vector<std::vector<double>>& values);

// The share of all overlaps that differs by more than 10 %.
[[nodiscard]] double ShareApart(const std::vector<ViewOverlap>& overlaps);

// Of overlaps of 1 % of the sphere and more. Refused: views_contradict, naming the views without
// which the others agree, if these are no more than half: half of one overlap contradicts, or 5 %
// of all. Else, whether more than a quarter of one is apart: what is warned, or empty.
[[nodiscard]] Result<std::string> JudgeOverlaps(const std::vector<ViewOverlap>& overlaps,
                                                const std::vector<std::string>& names);

}  // namespace lightcal
