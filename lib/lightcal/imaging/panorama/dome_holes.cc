// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/dome_holes.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace lightcal {
namespace {

constexpr int kHoleRows = 60, kHoleColumns = 120;
constexpr double kLeastHole = 1e-4;  // of the sphere

// The share of each coarse field that is unseen is above a half.
std::vector<bool> UnseenFields(std::span<const std::uint8_t> unseen, const LatLongGrid& grid) {
  std::vector<bool> fields;
  for (int row = 0; row < kHoleRows; ++row) {
    const int top = row * grid.height() / kHoleRows;
    const int bottom = std::max(top + 1, (row + 1) * grid.height() / kHoleRows);
    for (int column = 0; column < kHoleColumns; ++column) {
      const int left = column * grid.width() / kHoleColumns;
      const int right = std::max(left + 1, (column + 1) * grid.width() / kHoleColumns);
      int marked = 0;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          marked += unseen[static_cast<std::size_t>(grid.Index(x, y))] != 0 ? 1 : 0;
        }
      }
      fields.push_back(2 * marked > (bottom - top) * (right - left));
    }
  }
  return fields;
}

}  // namespace

std::vector<DomeHole> HolesOf(std::span<const std::uint8_t> unseen, const LatLongGrid& grid) {
  std::vector<bool> open = UnseenFields(unseen, grid);
  const LatLongGrid coarse(kHoleColumns, kHoleRows);
  std::vector<DomeHole> holes;
  std::vector<std::int32_t> front;
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (!open[start]) continue;
    open[start] = false;
    front.push_back(static_cast<std::int32_t>(start));
    Vec3 sum{};
    double area = 0.0;
    while (!front.empty()) {
      const std::int32_t at = front.back();
      front.pop_back();
      const int x = coarse.X(at), y = coarse.Y(at);
      const double own = coarse.SolidAngle(y);
      area += own;
      sum = sum + coarse.Direction(x, y) * own;
      const auto visit = [&](int column, int row) {
        if (row < 0 || row >= kHoleRows) return;
        const std::int32_t next = coarse.Index((column + kHoleColumns) % kHoleColumns, row);
        if (!open[static_cast<std::size_t>(next)]) return;
        open[static_cast<std::size_t>(next)] = false;
        front.push_back(next);
      };
      visit(x - 1, y);
      visit(x + 1, y);
      visit(x, y - 1);
      visit(x, y + 1);
    }
    const double share = area / (4.0 * std::numbers::pi), length = Length(sum);
    if (share < kLeastHole || !(length > 0.0)) continue;
    holes.push_back({sum * (1.0 / length), share});
  }
  std::ranges::stable_sort(holes,
                           [](const DomeHole& a, const DomeHole& b) { return a.share > b.share; });
  return holes;
}

}  // namespace lightcal
