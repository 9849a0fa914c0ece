// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/photometric_type_c.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lightcal {
namespace {

double FinestStep(const std::vector<double>& angles, double coarsest) {
  double step = coarsest;
  for (std::size_t i = 1; i < angles.size(); ++i) step = std::min(step, angles[i] - angles[i - 1]);
  return step;
}

std::vector<double> EvenAngles(double to, double step) {
  const int count = static_cast<int>(to / step + 0.5);
  std::vector<double> out;
  for (int i = 0; i <= count; ++i) out.push_back(to * i / count);
  return out;
}

}  // namespace

Result<IntensityTable> AsTypeC(IntensityTable table) {
  if (table.grid().type == GoniometerType::kC) return table;
  constexpr double kLeastStep = 0.5;  // a finer sampling is larger than it is worth
  const IntensityGrid& grid = table.grid();
  const double c_step = std::max(kLeastStep, FinestStep(grid.horizontal_deg, 2.5));
  const double gamma_step = std::max(kLeastStep, FinestStep(grid.vertical_deg, 1.0));
  return SampledAsTypeC(table, EvenAngles(360.0, c_step), EvenAngles(180.0, gamma_step),
                        TableInterpolation::kLinear);
}

Result<PhotometricFile> AsTypeC(PhotometricFile file) {
  auto table = AsTypeC(std::move(file.table));
  if (!table) return Propagate(std::move(table));
  return PhotometricFile{std::move(file.header), std::move(*table)};
}

}  // namespace lightcal
