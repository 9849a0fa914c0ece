// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/distribution/chart_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "lightcal/core/statistics.h"
#include "lightcal/core/vec3.h"

namespace lightcal::fit {
namespace {

constexpr double kModelSigma = 0.003;  // relative: what no sample's sigma knows of
constexpr int kSectors = 72;           // azimuths that the covered cone is judged by

struct Direction {
  double gamma = 0.0, c = 0.0;
};

Direction DirectionOf(const LampAxes& axes, const Vec3& d) {
  const double x = Dot(d, axes.c0), y = Dot(d, axes.c90), z = Dot(d, axes.aim);
  return {std::atan2(std::hypot(x, y), z), std::atan2(y, x)};
}

}  // namespace

std::vector<ChartSample> OnChart(const LampAxes& axes, const std::vector<IntensitySample>& samples,
                                 double peak_cd) {
  std::vector<ChartSample> out;
  out.reserve(samples.size());
  for (const IntensitySample& sample : samples) {
    ChartSample& on = out.emplace_back();
    if (!(sample.sigma_cd > 0.0)) continue;
    const Direction at = DirectionOf(axes, sample.direction);
    on.u = at.gamma * std::cos(at.c);
    on.v = at.gamma * std::sin(at.c);
    on.value = sample.intensity_cd;
    const double model = kModelSigma * std::max(sample.intensity_cd, kDarkDirection * peak_cd);
    on.weight = 1.0 / (sample.sigma_cd * sample.sigma_cd + model * model);
  }
  return out;
}

double RoughPeak(const std::vector<IntensitySample>& samples) {
  std::vector<double> values;
  for (const IntensitySample& s : samples) {
    if (s.sigma_cd > 0.0) values.push_back(s.intensity_cd);
  }
  if (values.empty()) return 0.0;
  return AtRank(values, values.size() - 1 - values.size() / 200);
}

double CoveredCone(const std::vector<ChartSample>& chart) {
  std::array<double, kSectors> farthest{};
  for (const ChartSample& s : chart) {
    if (!(s.weight > 0.0)) continue;
    const double turn = std::atan2(s.v, s.u) / (2.0 * std::numbers::pi) + 1.0;
    const auto sector = static_cast<std::size_t>(turn * kSectors) % kSectors;
    farthest[sector] = std::max(farthest[sector], std::hypot(s.u, s.v));
  }
  return *std::ranges::min_element(farthest);
}

ChartGrid GridOver(const std::vector<ChartSample>& chart, int intervals) {
  double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;
  for (const ChartSample& s : chart) {
    if (!(s.weight > 0.0)) continue;
    left = std::min(left, s.u);
    right = std::max(right, s.u);
    low = std::min(low, s.v);
    high = std::max(high, s.v);
  }
  ChartGrid grid;
  grid.spacing = std::max(right - left, high - low) / intervals;
  const auto count = [&](double span) {
    return std::max(1, static_cast<int>(std::ceil(span / grid.spacing - 1e-9)));
  };
  const int across = count(right - left), up = count(high - low);
  grid.columns = across + 3;
  grid.rows = up + 3;
  grid.u0 = 0.5 * (left + right - across * grid.spacing);
  grid.v0 = 0.5 * (low + high - up * grid.spacing);
  return grid;
}

}  // namespace lightcal::fit
