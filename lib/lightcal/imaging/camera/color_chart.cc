// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/color_chart.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lightcal/colorimetry/cam02_ucs.h"
#include "lightcal/core/matrix3.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr std::size_t kLeastPatches = 6;
constexpr double kLeastY = 1.0;
constexpr double kMostDistance = 10.0;

double Distance(const Cam02Ucs& p, const Cam02Ucs& q) {
  return std::hypot(p.J - q.J, p.a - q.a, p.b - q.b);
}

}  // namespace

Result<CameraColor> FitChart(std::span<const ChartPatch> patches, const Xyz& white) {
  const auto too_small = [] {
    return Refused("chart_too_small", "chart",
                   "a matrix needs six patches of different colours or more");
  };
  if (patches.size() < kLeastPatches) return too_small();
  const auto n = static_cast<Eigen::Index>(patches.size());
  Eigen::MatrixXd raw(n, 3), xyz(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ChartPatch& patch = patches[static_cast<std::size_t>(i)];
    const double weight = std::pow(std::max(kLeastY, patch.reference.Y), -2.0 / 3.0);
    raw.row(i) << patch.raw[0], patch.raw[1], patch.raw[2];
    xyz.row(i) << patch.reference.X, patch.reference.Y, patch.reference.Z;
    raw.row(i) *= weight;
    xyz.row(i) *= weight;
  }
  const auto solver = raw.colPivHouseholderQr();
  if (solver.rank() < 3) return too_small();
  const Eigen::Matrix3d m = solver.solve(xyz).transpose();
  CameraColor color;
  color.source = ColorMatrixSource::kChart;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      color.xyz_from_raw[i][j] = m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  const Cam02UcsUnder under(white);
  double sum = 0.0, most = 0.0;
  for (const ChartPatch& patch : patches) {
    const Column3 seen = Times(color.xyz_from_raw, patch.raw);
    const double off = Distance(under.Of(patch.reference), under.Of({seen[0], seen[1], seen[2]}));
    sum += off;
    most = std::max(most, off);
  }
  const double mean = sum / static_cast<double>(patches.size());
  if (!(mean < kMostDistance)) {
    return Refused("chart_disagrees", "chart",
                   "its patches are " + RoundedText(mean, 2) +
                       " (CAM02-UCS) from what the file says, on average: give corners in the "
                       "order upper left, upper right, lower right, lower left, as the chart is "
                       "read, and the light's own white (lamp_xy)");
  }
  color.delta_e_mean = mean;
  color.delta_e_max = most;
  const auto lightest = std::ranges::max_element(
      patches, {}, [](const ChartPatch& patch) { return patch.reference.Y; });
  const double scale = lightest->raw[1] / Times(color.xyz_from_raw, lightest->raw)[1];
  for (auto& row : color.xyz_from_raw) {
    for (double& value : row) value *= scale;
  }
  return color;
}

Result<ChartGrid> ChartGrid::Make(const std::array<double, 8>& corners, int columns, int rows) {
  constexpr std::array<std::array<double, 2>, 4> kUnit = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Eigen::Matrix<double, 8, 8> terms;
  Eigen::Matrix<double, 8, 1> places;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto [u, v] = kUnit[static_cast<std::size_t>(i)];
    const double x = corners[static_cast<std::size_t>(2 * i)];
    const double y = corners[static_cast<std::size_t>(2 * i + 1)];
    terms.row(2 * i) << u, v, 1, 0, 0, 0, -u * x, -v * x;
    terms.row(2 * i + 1) << 0, 0, 0, u, v, 1, -u * y, -v * y;
    places[2 * i] = x;
    places[2 * i + 1] = y;
  }
  const auto solver = terms.fullPivLu();
  const Eigen::Matrix<double, 8, 1> h = solver.solve(places);
  ChartGrid grid;
  grid.columns_ = std::max(1, columns - 1);
  grid.rows_ = std::max(1, rows - 1);
  for (std::size_t i = 0; i < 8; ++i) grid.h_[i] = h[static_cast<Eigen::Index>(i)];
  const bool in_front = 1.0 + h[6] > 0.0 && 1.0 + h[7] > 0.0 && 1.0 + h[6] + h[7] > 0.0;
  if (!solver.isInvertible() || !h.allFinite() || !in_front) {
    return Refused("bad_corners", "corners",
                   "the four corners make no quadrilateral; give the centres of the corner patches "
                   "as upper left, upper right, lower right, lower left");
  }
  return grid;
}

std::array<double, 2> ChartGrid::Place(double column, double row) const {
  const double u = column / columns_, v = row / rows_;
  const double w = h_[6] * u + h_[7] * v + 1.0;
  return {(h_[0] * u + h_[1] * v + h_[2]) / w, (h_[3] * u + h_[4] * v + h_[5]) / w};
}

}  // namespace lightcal
