// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/placed_starts.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lightcal/core/even_directions.h"

namespace lightcal::fit {
namespace {

constexpr double kSame = 1e-9;  // of the layout's extent, of unit vectors
constexpr double kLeastPivot = 1e-6;
constexpr int kDirections = 300;
constexpr int kDistances = 14;
constexpr double kNearestStart = 0.15;  // in extents of the layout
constexpr double kFarthest = 40.0;
constexpr std::size_t kMostStarts = 8;

bool Lit(const PlacedRow& row) { return row.direct_gain > 0.0; }
bool Placed(const PlacedRow& row) { return Lit(row) && row.position.has_value(); }

// Illuminance of the lamp alone, or nothing where the row says little of it.
std::optional<double> DirectOf(const PlacedRow& row, double ambient) {
  const double direct = (row.measured - row.ambient_gain * ambient) / row.direct_gain;
  if (row.form == RowForm::kLinear || !(direct > 0.0)) return std::nullopt;
  return direct;
}

// |p|^2 = 2 sum_k (p.axes_k) s_k - q + c E^(-power), p from `origin`.
struct LinearForm {
  Vec3 origin{};
  std::vector<Vec3> axes;
  double power = 1.0;
};

// (s_k..., q, c), or nothing where the rows do not determine them.
std::optional<Eigen::VectorXd> SolveLinear(const PlacedEstimation& estimation,
                                           const LinearForm& form, double ambient) {
  const auto axes = static_cast<Eigen::Index>(form.axes.size());
  const Eigen::Index unknowns = axes + 2;
  Eigen::MatrixXd a(static_cast<Eigen::Index>(estimation.rows.size()), unknowns);
  Eigen::VectorXd b(a.rows());
  Eigen::Index n = 0;
  for (const PlacedRow& row : estimation.rows) {
    if (!Placed(row)) continue;
    const auto direct = DirectOf(row, ambient);
    if (!direct) continue;
    const Vec3 p = *row.position - form.origin;
    const double term = std::pow(*direct, -form.power);
    const double weight = 1.0 / (row.sigma * term);
    for (Eigen::Index k = 0; k < axes; ++k) {
      a(n, k) = 2.0 * weight * Dot(p, form.axes[static_cast<std::size_t>(k)]);
    }
    a(n, axes) = -weight;
    a(n, axes + 1) = weight * term;
    b[n++] = weight * Dot(p, p);
  }
  if (n < unknowns) return std::nullopt;
  const Eigen::VectorXd scale = a.topRows(n).colwise().norm().transpose();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a.topRows(n) * scale.cwiseInverse().asDiagonal());
  qr.setThreshold(kLeastPivot);
  if (qr.rank() < unknowns) return std::nullopt;
  return scale.cwiseInverse().asDiagonal() * qr.solve(b.head(n));
}

PlacedTheta ThetaOf(const PlacedEstimation& estimation, double intensity, const Vec3& lamp,
                    double ambient) {
  PlacedTheta theta = {std::log(intensity), lamp[0], lamp[1], lamp[2], ambient};
  for (int k = kPlacedOffset; k < kPlacedParameters; ++k) theta[k] = estimation.rules[k].prior_mean;
  return theta;
}

std::optional<PlacedTheta> FromCommonPlane(const PlacedEstimation& estimation,
                                           const CommonPlane& plane, double ambient) {
  const bool faces = estimation.aim && Dot(*estimation.aim, plane.normal) < kSame - 1.0;
  if (estimation.aim && !faces) return std::nullopt;
  const LinearForm form{plane.origin, {plane.across, plane.along}, faces ? 1.0 / 2.0 : 2.0 / 3.0};
  const auto x = SolveLinear(estimation, form, ambient);
  if (!x) return std::nullopt;
  const double h2 = (*x)[2] - (*x)[0] * (*x)[0] - (*x)[1] * (*x)[1];
  const double c = (*x)[3];
  if (!(h2 > 0.0) || !(c > 0.0)) return std::nullopt;
  const double h = std::sqrt(h2);
  const Vec3 lamp =
      plane.origin + plane.across * (*x)[0] + plane.along * (*x)[1] + plane.normal * h;
  return ThetaOf(estimation, faces ? c * c / h2 : c * std::sqrt(c) / h, lamp, ambient);
}

std::optional<PlacedTheta> FromFacingMeters(const PlacedEstimation& estimation, double ambient) {
  const bool facing = std::ranges::all_of(
      estimation.rows, [](const PlacedRow& row) { return !Placed(row) || !row.normal; });
  if (!facing || estimation.aim) return std::nullopt;
  const LinearForm form{
      LayoutOf(estimation.rows).middle, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, 1.0};
  const auto x = SolveLinear(estimation, form, ambient);
  if (!x || !((*x)[4] > 0.0)) return std::nullopt;
  return ThetaOf(estimation, (*x)[4], form.origin + Vec3{(*x)[0], (*x)[1], (*x)[2]}, ambient);
}

// ln I as the weighted mean of what each row asks for at this place, and chi-squared about it.
struct ScanPoint {
  double chi_squared = std::numeric_limits<double>::infinity();
  double ln_intensity = 0.0;
  Vec3 lamp{};
};
ScanPoint Evaluate(const PlacedEstimation& estimation, const Vec3& lamp, double ambient) {
  double w = 0.0;
  double x = 0.0;
  double xx = 0.0;
  const PlacedTheta one_candela = ThetaOf(estimation, 1.0, lamp, 0.0);
  for (const PlacedRow& row : estimation.rows) {
    if (!Lit(row)) continue;
    double per_candela = 0.0;
    if (!PlacedIlluminance(row, estimation.aim, one_candela.data(), &per_candela)) {
      return {};
    }
    const auto direct = DirectOf(row, ambient);
    if (!direct || row.form == RowForm::kCensored) continue;
    const double value = std::log(*direct * row.direct_gain / per_candela);
    const double weight = 1.0 / (row.sigma * row.sigma);
    w += weight;
    x += weight * value;
    xx += weight * value * value;
  }
  if (!(w > 0.0)) return {};
  return {xx - x * x / w, x / w, lamp};
}

bool Alike(const Vec3& a, const Vec3& b, const Vec3& middle) {
  return Length(a - b) < 0.5 * std::min(Length(a - middle), Length(b - middle));
}

}  // namespace

Layout LayoutOf(const std::vector<PlacedRow>& rows) {
  Layout out;
  int count = 0;
  for (const PlacedRow& row : rows) {
    if (!Placed(row)) continue;
    out.middle = out.middle + *row.position;
    ++count;
  }
  if (count == 0) return out;
  out.middle = out.middle * (1.0 / count);
  double sum = 0.0;
  for (const PlacedRow& row : rows) {
    if (!Placed(row)) continue;
    const Vec3 from = *row.position - out.middle;
    sum += Dot(from, from);
  }
  if (sum > 0.0) out.extent = std::sqrt(sum / count);
  return out;
}

std::optional<CommonPlane> CommonPlaneOf(const std::vector<PlacedRow>& rows) {
  const auto first = std::ranges::find_if(rows, Placed);
  if (first == rows.end() || !first->normal) return std::nullopt;
  const Layout layout = LayoutOf(rows);
  const Vec3 normal = *first->normal;
  for (const PlacedRow& row : rows) {
    if (!Placed(row)) continue;
    if (!row.normal || Length(*row.normal - normal) > kSame) return std::nullopt;
    if (std::abs(Dot(*row.position - layout.middle, normal)) > kSame * layout.extent) {
      return std::nullopt;
    }
  }
  const Vec3 helper = std::abs(normal[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 sideways = Cross(normal, helper);
  const Vec3 along = sideways * (1.0 / Length(sideways));
  return CommonPlane{layout.middle, normal, Cross(along, normal), along};
}

std::optional<PlacedTheta> LinearPlacedStart(const PlacedEstimation& estimation, double ambient) {
  if (const auto plane = CommonPlaneOf(estimation.rows)) {
    return FromCommonPlane(estimation, *plane, ambient);
  }
  return FromFacingMeters(estimation, ambient);
}

std::optional<PlacedTheta> PlacedStartAt(const PlacedEstimation& estimation, const Vec3& lamp,
                                         double ambient) {
  const ScanPoint point = Evaluate(estimation, lamp, ambient);
  if (!std::isfinite(point.chi_squared)) return std::nullopt;
  return ThetaOf(estimation, std::exp(point.ln_intensity), lamp, ambient);
}

std::vector<PlacedTheta> ScanPlacedStarts(PlacedEstimation estimation, double ambient) {
  // For a start a small flat lamp is near enough, and so many faces would take long.
  for (PlacedRow& row : estimation.rows) row.face.reset();
  const Layout layout = LayoutOf(estimation.rows);
  std::vector<ScanPoint> points;
  for (int k = 0; k < kDistances; ++k) {
    const double share = static_cast<double>(k) / (kDistances - 1);
    const double radius =
        layout.extent * kNearestStart * std::pow(kFarthest / kNearestStart, share);
    for (int i = 0; i < kDirections; ++i) {
      const ScanPoint point =
          Evaluate(estimation, layout.middle + EvenDirection(i, kDirections) * radius, ambient);
      if (std::isfinite(point.chi_squared)) points.push_back(point);
    }
  }
  std::ranges::sort(
      points, [](const ScanPoint& a, const ScanPoint& b) { return a.chi_squared < b.chi_squared; });
  std::vector<Vec3> kept;
  std::vector<PlacedTheta> starts;
  for (const ScanPoint& point : points) {
    const bool known = std::ranges::any_of(
        kept, [&](const Vec3& other) { return Alike(point.lamp, other, layout.middle); });
    if (known) continue;
    kept.push_back(point.lamp);
    starts.push_back(ThetaOf(estimation, std::exp(point.ln_intensity), point.lamp, ambient));
    if (starts.size() == kMostStarts) break;
  }
  return starts;
}

std::optional<PlacedTheta> BestStartAt(PlacedEstimation estimation, double extents,
                                       double ambient) {
  for (PlacedRow& row : estimation.rows) row.face.reset();
  const Layout layout = LayoutOf(estimation.rows);
  ScanPoint best;
  for (int i = 0; i < kDirections; ++i) {
    const Vec3 lamp = layout.middle + EvenDirection(i, kDirections) * (extents * layout.extent);
    const ScanPoint point = Evaluate(estimation, lamp, ambient);
    if (point.chi_squared < best.chi_squared) best = point;
  }
  if (!std::isfinite(best.chi_squared)) return std::nullopt;
  return ThetaOf(estimation, std::exp(best.ln_intensity), best.lamp, ambient);
}

}  // namespace lightcal::fit
