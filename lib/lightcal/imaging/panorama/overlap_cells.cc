// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/overlap_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/panorama/latlong_grid.h"

namespace lightcal {
namespace {

constexpr int kCellSide = 4;        // kCellSide x kCellSide points of a cell
constexpr double kLeastSd = 0.005;  // of a cell: edges, reflections, resampling

OverlapView SightOf(const AimedPicture& picture, std::size_t view, int x, int y) {
  double sum = 0.0, sum2 = 0.0, radius2 = 0.0;
  for (int i = 0; i < kCellSide * kCellSide; ++i) {
    const double azimuth =
        2.0 * std::numbers::pi * (x + (i % kCellSide + 0.5) / kCellSide) / kOverlapColumns;
    const double zenith = std::numbers::pi * (y + (i / kCellSide + 0.5) / kCellSide) / kOverlapRows;
    const auto seen = picture.view.See({-std::sin(azimuth) * std::sin(zenith),
                                        -std::cos(azimuth) * std::sin(zenith), std::cos(zenith)});
    if (!seen || seen->worth < 1.0) return {};
    const PictureTap tap = TapAt(picture.view.angles().view(), seen->point);
    if (AnyClipped(picture, tap)) return {std::nullopt, true};
    double value = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      value += double{tap.weight[k] * picture.nits.data()[tap.pixel[k]]} / seen->passed;
    }
    sum += value;
    sum2 += value * value;
    radius2 += seen->rim_share * seen->rim_share / (kCellSide * kCellSide);
  }
  const double count = kCellSide * kCellSide, mean = sum / count;
  if (!(mean > 0.0)) return {};
  const double scatter2 = std::max(0.0, sum2 / count - mean * mean) / (mean * mean) / count;
  OverlapSight sight{view, std::log(mean), scatter2 + kLeastSd * kLeastSd, {}};
  sight.radius = {radius2, radius2 * radius2, radius2 * radius2 * radius2};
  return {sight, false};
}

}  // namespace

std::vector<std::vector<OverlapView>> OverlapSights(std::span<const AimedPicture> views) {
  std::vector<std::vector<OverlapView>> cells(static_cast<std::size_t>(kOverlapRows) *
                                              kOverlapColumns);
  ParallelFor(kOverlapRows, [&](int y) {
    for (int x = 0; x < kOverlapColumns; ++x) {
      auto& cell = cells[static_cast<std::size_t>(y * kOverlapColumns + x)];
      cell.reserve(views.size());
      for (std::size_t i = 0; i < views.size(); ++i) cell.push_back(SightOf(views[i], i, x, y));
    }
  });
  return cells;
}

double OverlapCellArea(int row) {
  const LatLongGrid grid(kOverlapColumns, kOverlapRows);
  return grid.SolidAngle(row) / grid.SolidAngle(kOverlapRows / 2);
}

}  // namespace lightcal
