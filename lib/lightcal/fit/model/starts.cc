// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "lightcal/core/weighted_median.h"

namespace lightcal::fit {
namespace {

bool CarriesIntensity(const ReadingRow& row, double ambient) {
  return row.form == ReadingRow::Form::kLog && row.direct_gain > 0.0 &&
         row.measured > row.ambient_gain * ambient;
}

// What a row that carries intensity asks for; infinite where the lamp, moved by d0, shines past it.
double LnIntensityOf(const ReadingRow& row, double d0, double ambient) {
  const double per_candela = LuxPerCandela(row, d0);
  if (per_candela == 0.0) return std::numeric_limits<double>::infinity();
  return std::log((row.measured - row.ambient_gain * ambient) / per_candela);
}

double MeanLnIntensity(const Estimation& estimation, double d0, double ambient) {
  double sum = 0.0;
  double weights = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    if (!CarriesIntensity(row, ambient)) continue;
    const double weight = 1.0 / (row.sigma * row.sigma);
    sum += weight * LnIntensityOf(row, d0, ambient);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

// Offsets worth trying: from the box to three prior widths, evenly.
struct OffsetRange {
  double low = 0.0;
  double high = 0.0;
};
OffsetRange ScanRange(const Estimation& estimation) {
  const ParameterRule& rule = estimation.rules[kDistanceOffset];
  if (!rule.free) return {rule.prior_mean, rule.prior_mean};
  const double reach = std::max(3.0 * rule.prior_sd, -estimation.least_distance_offset);
  return {estimation.least_distance_offset * 0.999, reach};
}

double OffsetPriorChiSquared(const Estimation& estimation, double d0) {
  const ParameterRule& rule = estimation.rules[kDistanceOffset];
  if (!rule.free || !(rule.prior_sd > 0.0)) return 0.0;
  const double z = (d0 - rule.prior_mean) / rule.prior_sd;
  return z * z;
}

struct LinearFit {
  double intensity = 0.0;
  double ambient = 0.0;
  double chi_squared = std::numeric_limits<double>::infinity();
};

// Non-negative weighted least squares of m = I a + E0 b at fixed d0; with E0 held, b's share of the
// prior mean is subtracted.
LinearFit FitIntensityAndAmbient(const Estimation& estimation, double d0) {
  const ParameterRule& rule = estimation.rules[kAmbient];
  double aa = 0.0, ab = 0.0, bb = 0.0, am = 0.0, bm = 0.0, mm = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    if (row.form == ReadingRow::Form::kCensored) continue;
    const double sigma = row.form == ReadingRow::Form::kLog ? row.sigma * row.measured : row.sigma;
    const double w = 1.0 / sigma;
    const double a = w * LampPerCandela(row, d0);
    const double b = w * row.ambient_gain;
    const double m = w * row.measured - (rule.free ? 0.0 : b * rule.prior_mean);
    aa += a * a;
    ab += a * b;
    bb += b * b;
    am += a * m;
    bm += b * m;
    mm += m * m;
  }
  if (rule.free && rule.prior_sd > 0.0) bb += 1.0 / (rule.prior_sd * rule.prior_sd);
  LinearFit fit;
  if (!(aa > 0.0)) return fit;
  const double determinant = aa * bb - ab * ab;
  if (rule.free && determinant > 1e-12 * aa * bb) {
    fit.intensity = (am * bb - bm * ab) / determinant;
    fit.ambient = (bm * aa - am * ab) / determinant;
  }
  if (fit.intensity <= 0.0 || fit.ambient <= 0.0) fit = {am / aa, 0.0, 0.0};
  if (!(fit.intensity > 0.0)) return {};
  fit.chi_squared = mm - 2.0 * (fit.intensity * am + fit.ambient * bm) +
                    fit.intensity * fit.intensity * aa + 2.0 * fit.intensity * fit.ambient * ab +
                    fit.ambient * fit.ambient * bb;
  if (!rule.free) fit.ambient = rule.prior_mean;
  return fit;
}

double AbsoluteDeviation(const Estimation& estimation, const Theta& theta) {
  double sum = 0.5 * OffsetPriorChiSquared(estimation, theta[kDistanceOffset]);
  for (const ReadingRow& row : estimation.rows) sum += std::abs(RowResidual(row, theta));
  return sum;
}

// At most kMostScanned rows, evenly taken: the scan only has to end near the optimum.
Estimation Thinned(const Estimation& estimation) {
  constexpr std::size_t kMostScanned = 24;
  const std::size_t n = estimation.rows.size();
  if (n <= kMostScanned) return estimation;
  Estimation out = estimation;
  out.rows.clear();
  for (std::size_t i = 0; i < kMostScanned; ++i) {
    out.rows.push_back(estimation.rows[i * n / kMostScanned]);
  }
  return out;
}

// A start with the walls' light as known as its prior says.
template <class Start>
Theta AtPriorWalls(const Estimation& estimation, const Start& start) {
  Theta walls{};
  walls[kLnWalls] = estimation.rules[kLnWalls].prior_mean;
  walls[kWallsSlope] = estimation.rules[kWallsSlope].prior_mean;
  Estimation held = estimation;
  held.rules[kLnWalls] = held.rules[kWallsSlope] = {};
  for (ReadingRow& row : held.rows) {
    row.bounce += WallsPerCandela(row, walls.data());
    row.walls.reset();
  }
  Theta theta = start(held);
  theta[kLnWalls] = walls[kLnWalls];
  theta[kWallsSlope] = walls[kWallsSlope];
  return theta;
}

}  // namespace

Theta ClosedFormStart(const Estimation& estimation, double ambient) {
  if (estimation.rules[kLnWalls].free) {
    return AtPriorWalls(estimation,
                        [&](const Estimation& held) { return ClosedFormStart(held, ambient); });
  }
  const ParameterRule& rule = estimation.rules[kDistanceOffset];
  if (!rule.free) {
    return {MeanLnIntensity(estimation, rule.prior_mean, ambient), rule.prior_mean, ambient};
  }
  // y = 1/sqrt(E cos..) = k d + k d0; sd of y is y sigma/2. Unknown k and c = k d0; the prior of d0
  // is a row (0 = c - k mean)/(k sd) with k from the far reading.
  double kk = 0.0, kc = 0.0, cc = 0.0, ky = 0.0, cy = 0.0;
  double mean_k = 0.0;
  double weights = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    if (!CarriesIntensity(row, ambient)) continue;
    const double direct = row.measured - row.ambient_gain * ambient;
    const double gain = LuxPerCandela(row, 0.0) * row.distance * row.distance;
    const double y = std::sqrt(gain / direct);
    const double w = 2.0 / (y * row.sigma);
    kk += w * w * row.distance * row.distance;
    kc += w * w * row.distance;
    cc += w * w;
    ky += w * w * row.distance * y;
    cy += w * w * y;
    mean_k += y / row.distance;
    weights += 1.0;
  }
  if (!(weights > 0.0)) return {0.0, rule.prior_mean, ambient};
  mean_k /= weights;
  if (rule.prior_sd > 0.0) {
    const double w = 1.0 / (mean_k * rule.prior_sd);
    cc += w * w;
    cy += w * w * mean_k * rule.prior_mean;
  }
  const double determinant = kk * cc - kc * kc;
  double d0 = rule.prior_mean;
  if (determinant > 1e-12 * kk * cc) {
    const double k = (ky * cc - cy * kc) / determinant;
    const double c = (cy * kk - ky * kc) / determinant;
    if (k > 0.0) d0 = c / k;
  }
  d0 = std::max(d0, 0.9 * estimation.least_distance_offset);
  return {MeanLnIntensity(estimation, d0, ambient), d0, ambient};
}

Theta ScanStart(const Estimation& estimation) {
  if (estimation.rules[kLnWalls].free) return AtPriorWalls(estimation, ScanStart);
  const OffsetRange range = ScanRange(estimation);
  Theta best = {0.0, estimation.rules[kDistanceOffset].prior_mean, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kScanPoints; ++i) {
    const double d0 = range.low + (range.high - range.low) * i / (kScanPoints - 1);
    const LinearFit fit = FitIntensityAndAmbient(estimation, d0);
    const double score = fit.chi_squared + OffsetPriorChiSquared(estimation, d0);
    if (score >= least) continue;
    least = score;
    best = {std::log(fit.intensity), d0, fit.ambient};
  }
  return best;
}

Theta StartOf(const Estimation& estimation) {
  const ParameterRule& ambient = estimation.rules[kAmbient];
  return ambient.free ? ScanStart(estimation) : ClosedFormStart(estimation, ambient.prior_mean);
}

namespace {

// Weighted median over the rows of the ln I each asks for; absent when none carries it.
std::optional<double> MedianLnIntensity(const Estimation& estimation, double d0, double ambient) {
  std::vector<WeightedValue> values;
  values.reserve(estimation.rows.size());
  for (const ReadingRow& row : estimation.rows) {
    if (!CarriesIntensity(row, ambient)) continue;
    values.push_back({LnIntensityOf(row, d0, ambient), 1.0 / row.sigma});
  }
  if (values.empty()) return std::nullopt;
  return WeightedMedian(values);
}

}  // namespace

Theta MedianStart(const Estimation& all) {
  if (all.rules[kLnWalls].free) return AtPriorWalls(all, MedianStart);
  const Estimation estimation = Thinned(all);
  // Fractions of the dimmest reading that may be ambient light.
  static constexpr std::array<double, 10> kAmbientLadder = {0.0,  0.02, 0.05, 0.1,  0.2,
                                                            0.35, 0.5,  0.7,  0.85, 0.95};
  const OffsetRange range = ScanRange(estimation);
  const ParameterRule& ambient_rule = estimation.rules[kAmbient];
  double dimmest = std::numeric_limits<double>::infinity();
  for (const ReadingRow& row : estimation.rows) {
    if (CarriesIntensity(row, 0.0)) dimmest = std::min(dimmest, row.measured);
  }
  Theta best = {0.0, estimation.rules[kDistanceOffset].prior_mean, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (const double fraction : kAmbientLadder) {
    const double ambient = ambient_rule.free ? fraction * dimmest : ambient_rule.prior_mean;
    for (int i = 0; i < kScanPoints; ++i) {
      const double d0 = range.low + (range.high - range.low) * i / (kScanPoints - 1);
      const std::optional<double> ln_intensity = MedianLnIntensity(estimation, d0, ambient);
      if (!ln_intensity) continue;
      const Theta candidate = {*ln_intensity, d0, ambient};
      const double score = AbsoluteDeviation(estimation, candidate);
      if (score >= least) continue;
      least = score;
      best = candidate;
    }
    if (!ambient_rule.free) break;
  }
  return best;
}

}  // namespace lightcal::fit
