// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/thin_table.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace lightcal {
namespace {

constexpr double kRounding = 1e-6;  // degrees, of angles as files print them

// Indices of the nodes that stay. angles_deg ascending, not empty.
std::vector<std::size_t> NodesApart(const std::vector<double>& angles_deg, double step_deg) {
  const std::size_t last = angles_deg.size() - 1;
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i < last; ++i) {
    if (angles_deg[i] - angles_deg[kept.back()] >= step_deg - kRounding) kept.push_back(i);
  }
  if (last > 0) kept.push_back(last);
  return kept;
}

std::vector<double> At(const std::vector<double>& angles_deg,
                       const std::vector<std::size_t>& kept) {
  std::vector<double> out;
  for (const std::size_t i : kept) out.push_back(angles_deg[i]);
  return out;
}

}  // namespace

Result<IntensityTable> ThinnedTable(const IntensityTable& table, double step_deg) {
  const IntensityGrid& grid = table.grid();
  const std::vector<std::size_t> planes = NodesApart(grid.horizontal_deg, step_deg);
  const std::vector<std::size_t> angles = NodesApart(grid.vertical_deg, step_deg);
  IntensityGrid thinned;
  thinned.type = grid.type;
  thinned.horizontal_deg = At(grid.horizontal_deg, planes);
  thinned.vertical_deg = At(grid.vertical_deg, angles);
  for (const std::size_t plane : planes) {
    for (const std::size_t angle : angles) {
      thinned.candela.push_back(grid.candela[plane * grid.vertical_deg.size() + angle]);
    }
  }
  return IntensityTable::Make(std::move(thinned), "thinned distribution");
}

}  // namespace lightcal
