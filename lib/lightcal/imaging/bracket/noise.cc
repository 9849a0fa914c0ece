// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightcal/core/parallel.h"

namespace lightcal {
namespace {

constexpr double kLeastSamples = 20.0;  // of a bin
constexpr double kHighestOfClip = 0.8;  // of the clip; above, sensors bend
constexpr int kGatePasses = 3;
constexpr int kFitPasses = 8;
constexpr double kLeastOffset = 1e-12;  // of a variance: no sensor is without read noise

// Variance of residuals at one level of one pair: variance = scale slope + offset intercept.
struct Point {
  double slope, intercept, variance, count;
};

// `shorter`, `longer`: what is left of the variance of each frame's samples.
std::vector<Point> PointsOf(const PairSums& sums, double ratio, double shorter, double longer) {
  std::vector<Point> points;
  for (int bin = 0; bin < kLevelBins && BinLowerLevel(bin + 1) < kHighestOfClip; ++bin) {
    const LevelSums& sum = sums[static_cast<std::size_t>(bin)];
    if (sum.count < kLeastSamples) continue;
    const double mean = sum.d / sum.count;
    const double signal = std::max(0.0, (sum.a + sum.b) / (1.0 + ratio) / sum.count);
    points.push_back({signal * ratio * (longer + ratio * shorter), longer + ratio * ratio * shorter,
                      (sum.d2 / sum.count - mean * mean) * sum.count / (sum.count - 1.0),
                      sum.count});
  }
  return points;
}

// Weighted least squares with weights from the fit itself: a variance from n residuals is known to
// a share sqrt(2/n).
std::optional<NoiseProfile> FitPoints(std::span<const Point> points) {
  if (points.empty()) return std::nullopt;
  NoiseProfile noise{0.0, 0.0};
  for (int pass = 0; pass < kFitPasses; ++pass) {
    double ss = 0.0, so = 0.0, oo = 0.0, sv = 0.0, ov = 0.0;
    for (const Point& p : points) {
      const double model =
          pass == 0 ? p.variance : noise.scale * p.slope + noise.offset * p.intercept;
      if (!(model > 0.0)) continue;
      const double weight = p.count / (model * model);
      ss += weight * p.slope * p.slope;
      so += weight * p.slope * p.intercept;
      oo += weight * p.intercept * p.intercept;
      sv += weight * p.slope * p.variance;
      ov += weight * p.intercept * p.variance;
    }
    const double determinant = ss * oo - so * so;
    if (!(oo > 0.0)) return std::nullopt;
    const bool both = determinant > 1e-9 * ss * oo;
    noise.scale = both ? (sv * oo - ov * so) / determinant : 0.0;
    noise.offset = both ? (ov * ss - sv * so) / determinant : ov / oo;
    if (noise.scale < 0.0) noise = {0.0, ov / oo};
    if (noise.offset < kLeastOffset && ss > 0.0) noise = {sv / ss, kLeastOffset};
  }
  if (!(noise.scale > 0.0) && !(noise.offset > 0.0)) return std::nullopt;
  return noise;
}

}  // namespace

std::optional<NoiseProfile> EstimateNoise(const SampledSignals& signals,
                                          std::span<const double> exposure,
                                          std::span<const double> shares) {
  std::optional<NoiseProfile> noise;
  const std::size_t pairs = signals.frames.empty() ? 0 : signals.frames.size() - 1;
  std::vector<std::array<double, kLevelBins>> gates(pairs);
  for (int pass = 0; pass < kGatePasses; ++pass) {
    std::vector<std::vector<Point>> points(pairs);
    ParallelFor(static_cast<int>(pairs), [&](int i) {
      const auto a = static_cast<std::size_t>(i);
      PairSetting setting{.ratio = exposure[a + 1] / exposure[a],
                          .noise = noise.value_or(kMiddlingNoise),
                          .gate = gates[a]};
      const auto& shorter = signals.frames[a];
      const auto& longer = signals.frames[a + 1];
      const PairClips clips = ClipsOfPair(signals, a, a + 1);
      if (pass == 0) setting.gate = FirstGates(shorter, longer, clips.clip, setting);
      const PairSums sums = ComparePair(shorter, longer, clips.clip, setting);
      gates[a] = GatesOf(sums);
      points[a] = PointsOf(sums, setting.ratio, shares.empty() ? 1.0 : shares[a],
                           shares.empty() ? 1.0 : shares[a + 1]);
    });
    std::vector<Point> all;
    for (const auto& some : points) all.insert(all.end(), some.begin(), some.end());
    noise = FitPoints(all);
    if (!noise) return std::nullopt;
  }
  return noise;
}

}  // namespace lightcal
