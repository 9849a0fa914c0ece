// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/photometric_type_c.h"

#include <algorithm>
#include <cmath>
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

// The angles a table of type A or B is sampled at.
IntensityGrid SamplingOf(const IntensityTable& table) {
  constexpr double kLeastStep = 0.5;  // a finer sampling is larger than it is worth
  const IntensityGrid& grid = table.grid();
  const double c_step = std::max(kLeastStep, FinestStep(grid.horizontal_deg, 2.5));
  const double gamma_step = std::max(kLeastStep, FinestStep(grid.vertical_deg, 1.0));
  return {GoniometerType::kC, EvenAngles(360.0, c_step), EvenAngles(180.0, gamma_step), {}};
}

}  // namespace

Result<PhotometricFile> AsTypeC(PhotometricFile file) {
  if (file.table.grid().type == GoniometerType::kC) return file;
  IntensityGrid grid = SamplingOf(file.table);
  auto table = SampledAsTypeC(file.table, std::move(grid.horizontal_deg),
                              std::move(grid.vertical_deg), TableInterpolation::kLinear);
  if (!table) return Propagate(std::move(table));
  return PhotometricFile{std::move(file.header), std::move(*table)};
}

Result<IntensityTable> AboutItsAim(IntensityTable table) {
  if (table.grid().type == GoniometerType::kC) return table;
  IntensityGrid grid = SamplingOf(table);
  const bool type_a = table.grid().type == GoniometerType::kA;
  for (const double c_deg : grid.horizontal_deg) {
    for (const double gamma_deg : grid.vertical_deg) {
      const double c = RadiansFromDegrees(c_deg).value();
      const double gamma = RadiansFromDegrees(gamma_deg).value();
      const double across = std::sin(gamma);
      // Type A aims along +X; C0 is to its right (-Y), C90 up (+Z).
      const Vec3 d = type_a ? Vec3{std::cos(gamma), -across * std::cos(c), across * std::sin(c)}
                            : Vec3{across * std::cos(c), across * std::sin(c), -std::cos(gamma)};
      grid.candela.push_back(table.Towards(d).value());
    }
  }
  return IntensityTable::Make(std::move(grid), "sampled distribution");
}

}  // namespace lightcal
