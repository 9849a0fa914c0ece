// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/planckian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/cie_tables/tables.h"

namespace lightcal {
namespace {

// g and its first two derivatives by x.
struct Ratio {
  double g, g1, g2;
};

// The closed forms, with q = exp(-x) (times any scale) and w = 1 - exp(-x).
Ratio RatioFrom(double x, double q, double w) {
  const double r = 1.0 / w;
  return {x * q * r, q * (w - x) * r * r, q * (x * (2.0 - w) - 2.0 * w) * r * r * r};
}

// g of every wavelength of one body, all times exp(least_x): without that common factor, which
// cancels in a chromaticity, cold bodies underflow.
class ScaledRatio {
 public:
  explicit ScaledRatio(double least_x)
      : least_x_(least_x),
        scale_(std::exp(std::min(least_x, kSmall))),
        unscale_(std::exp(-least_x)) {}

  // x >= least_x. One exponential each.
  [[nodiscard]] Ratio At(double x) const {
    if (x < kSeries) {  // the closed forms cancel; relative error of the series below 1e-12
      const double x2 = x * x;
      return {scale_ * (1.0 + x * (-0.5 + x * (1.0 / 12.0 - x2 * (1.0 / 720.0 - x2 / 30240.0)))),
              scale_ * (-0.5 + x * (1.0 / 6.0 - x2 * (1.0 / 180.0 - x2 / 5040.0))),
              scale_ * (1.0 / 6.0 - x2 * (1.0 / 60.0 - x2 * (1.0 / 1008.0 - x2 / 21600.0)))};
    }
    if (x < kSmall) {
      const double w = -std::expm1(-x);
      return RatioFrom(x, scale_ * (1.0 - w), w);
    }
    const double q = std::exp(least_x_ - x);
    return RatioFrom(x, q, 1.0 - q * unscale_);
  }

 private:
  static constexpr double kSeries = 0.05;
  static constexpr double kSmall = 0.5;  // from here 1 - exp(-x) does not cancel
  double least_x_;
  double scale_;  // exp(least_x) wherever some x is below kSmall
  double unscale_;
};

// Sum over wavelength of l^-4 g(c2/(l T)) times each colour-matching function, and its derivatives
// by mireds; all three share one free scale.
struct TristimulusSums {
  std::array<double, 3> value{}, first{}, second{};
};

struct PlanckTerm {
  double x_per_mired;  // c2/l in K, times 1e-6
  double weight;       // (l / 560 nm)^-4
};

const std::array<PlanckTerm, kCmfCount>& PlanckTerms() {
  static const auto terms = [] {
    std::array<PlanckTerm, kCmfCount> all{};
    for (int i = 0; i < kCmfCount; ++i) {
      const double nm = kCmfFirstNm + i;
      all[i] = {kC2MetreKelvin / (nm * 1e-9) * 1e-6, std::pow(nm / 560.0, -4)};
    }
    return all;
  }();
  return terms;
}

TristimulusSums SumsAt(double mireds) {
  const auto& terms = PlanckTerms();
  const auto& table = Cie1931Cmf();
  const ScaledRatio ratio(terms.back().x_per_mired * mireds);
  // Sums of their own: in registers, not in the arrays.
  double x0 = 0.0, y0 = 0.0, z0 = 0.0;
  double x1 = 0.0, y1 = 0.0, z1 = 0.0;
  double x2 = 0.0, y2 = 0.0, z2 = 0.0;
  for (int i = 0; i < kCmfCount; ++i) {
    const double s = terms[i].x_per_mired;
    const double weight = terms[i].weight;
    const Ratio r = ratio.At(s * mireds);
    const CmfRow& row = table[static_cast<std::size_t>(i)];
    const double value = weight * r.g;
    const double first = weight * r.g1 * s;
    const double second = weight * r.g2 * s * s;
    x0 += value * row.x_bar;
    y0 += value * row.y_bar;
    z0 += value * row.z_bar;
    x1 += first * row.x_bar;
    y1 += first * row.y_bar;
    z1 += first * row.z_bar;
    x2 += second * row.x_bar;
    y2 += second * row.y_bar;
    z2 += second * row.z_bar;
  }
  return {{x0, y0, z0}, {x1, y1, z1}, {x2, y2, z2}};
}

// u = 4X/(X+15Y+3Z), v = 6Y/(X+15Y+3Z).
struct UvParts {
  double u, v, denominator;
};
UvParts PartsOf(const std::array<double, 3>& c) {
  return {4.0 * c[0], 6.0 * c[1], c[0] + 15.0 * c[1] + 3.0 * c[2]};
}

}  // namespace

double PlanckRatio(double x) { return x < 1e-5 ? 1.0 - x / 2.0 + x * x / 12.0 : x / std::expm1(x); }

LocusPoint PlanckianLocusAt(Mireds reciprocal_temperature) {
  const TristimulusSums sums = SumsAt(reciprocal_temperature.value());
  const UvParts p = PartsOf(sums.value);
  const UvParts p1 = PartsOf(sums.first);
  const UvParts p2 = PartsOf(sums.second);
  LocusPoint at;
  const double d = p.denominator;
  at.uv = {p.u / d, p.v / d};
  at.du = (p1.u - at.uv.u * p1.denominator) / d;
  at.dv = (p1.v - at.uv.v * p1.denominator) / d;
  at.d2u = (p2.u - 2.0 * at.du * p1.denominator - at.uv.u * p2.denominator) / d;
  at.d2v = (p2.v - 2.0 * at.dv * p1.denominator - at.uv.v * p2.denominator) / d;
  return at;
}

Xyz PlanckianXyz(Kelvin temperature) {
  const TristimulusSums sums = SumsAt(MiredsFromKelvin(temperature).value());
  return {sums.value[0] / sums.value[1], 1.0, sums.value[2] / sums.value[1]};
}

}  // namespace lightcal
