// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/local_background.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/units.h"

namespace lightcal {
namespace {

constexpr int kCellRows = 60;  // of 3 degrees
constexpr double kPercentile = 0.7;
const double kNeighbourhoodCosine = std::cos(25.0 * kRadiansPerDegree);

// Rows or columns [from, to) of the picture that cell i of n covers; never none.
std::pair<int, int> Extent(int i, int n, int size) {
  const auto edge = [&](int k) { return static_cast<int>(std::int64_t{k} * size / n); };
  return {edge(i), std::max(edge(i) + 1, edge(i + 1))};
}

std::vector<double> CellMedians(View2d<const float> nits, const LatLongGrid& cells) {
  std::vector<double> medians(static_cast<std::size_t>(cells.width()) * cells.height());
  ParallelFor(cells.height(), [&](int cy) {
    std::vector<float> values;
    const auto [top, bottom] = Extent(cy, cells.height(), nits.height());
    for (int cx = 0; cx < cells.width(); ++cx) {
      const auto [left, right] = Extent(cx, cells.width(), nits.width());
      values.clear();
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) values.push_back(nits(x, y));
      }
      medians[static_cast<std::size_t>(cells.Index(cx, cy))] = UpperMedian(values);
    }
  });
  return medians;
}

struct BackgroundCell {
  double median = 0.0, solid_angle = 0.0;
  Vec3 direction;
};

// Row by row.
std::vector<BackgroundCell> CellsOf(View2d<const float> nits, const LatLongGrid& grid) {
  const std::vector<double> medians = CellMedians(nits, grid);
  std::vector<BackgroundCell> cells;
  cells.reserve(medians.size());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      cells.push_back({medians[static_cast<std::size_t>(grid.Index(x, y))], grid.SolidAngle(y),
                       grid.Direction(x, y)});
    }
  }
  return cells;
}

// `rising` are the same cells, the darkest first.
double PercentileAround(const std::vector<BackgroundCell>& cells,
                        const std::vector<BackgroundCell>& rising, const Vec3& centre) {
  const auto near = [&](const BackgroundCell& cell) {
    return Dot(centre, cell.direction) >= kNeighbourhoodCosine;
  };
  double total = 0.0;
  for (const BackgroundCell& cell : cells) {
    if (near(cell)) total += cell.solid_angle;
  }
  double below = 0.0, last = 0.0;
  for (const BackgroundCell& cell : rising) {
    if (!near(cell)) continue;
    last = cell.median;
    below += cell.solid_angle;
    if (below >= kPercentile * total) break;
  }
  return std::max(0.0, last);
}

}  // namespace

LocalBackground::LocalBackground(View2d<const float> nits, const LatLongGrid& grid)
    : cells_(std::min(2 * kCellRows, grid.width()), std::min(kCellRows, grid.height())),
      cells_per_x_(double(cells_.width()) / grid.width()),
      cells_per_y_(double(cells_.height()) / grid.height()),
      value_(static_cast<std::size_t>(cells_.width()) * cells_.height()) {
  const std::vector<BackgroundCell> cells = CellsOf(nits, cells_);
  std::vector<BackgroundCell> rising = cells;
  std::ranges::sort(rising, {}, [](const BackgroundCell& cell) {
    return std::pair(cell.median, cell.solid_angle);
  });
  ParallelFor(static_cast<int>(cells.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    value_[at] = PercentileAround(cells, rising, cells[at].direction);
  });
}

double LocalBackground::At(int x, int y) const {
  const double cx = (x + 0.5) * cells_per_x_ - 0.5, cy = (y + 0.5) * cells_per_y_ - 0.5;
  const double left = std::floor(cx), top = std::floor(cy);
  const double fx = cx - left, fy = cy - top;
  const auto value = [&](int dx, int dy) {
    const int column = (static_cast<int>(left) + dx + cells_.width()) % cells_.width();
    const int row = std::clamp(static_cast<int>(top) + dy, 0, cells_.height() - 1);
    return value_[static_cast<std::size_t>(cells_.Index(column, row))];
  };
  return (1.0 - fy) * ((1.0 - fx) * value(0, 0) + fx * value(1, 0)) +
         fy * ((1.0 - fx) * value(0, 1) + fx * value(1, 1));
}

}  // namespace lightcal
