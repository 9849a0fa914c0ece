// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/rough_beam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lightcal/core/statistics.h"
#include "lightcal/core/units.h"

namespace lightcal::fit {
namespace {

constexpr double kReach = 1.25;   // nodes beyond the outermost reading
constexpr double kHollow = 1.15;  // peak over axis, of a lamp that is brighter beside it

double RoughAt(const std::vector<RoughPoint>& curve, double gamma) {
  if (gamma <= curve.front().gamma) return curve.front().candela;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (gamma > curve[i].gamma) continue;
    const double span = curve[i].gamma - curve[i - 1].gamma;
    const double t = span > 0.0 ? (gamma - curve[i - 1].gamma) / span : 1.0;
    return curve[i - 1].candela + t * (curve[i].candela - curve[i - 1].candela);
  }
  return -1.0;
}

}  // namespace

std::vector<RoughPoint> RoughCurve(const std::vector<BeamRow>& rows) {
  const std::array<double, kBeamCommon> as_stated{};
  std::vector<RoughPoint> curve;
  for (const BeamRow& row : rows) {
    if (!row.lit) continue;
    const auto towards = TowardsOf(row, as_stated.data());
    if (!(towards.per_candela > 0.0)) continue;
    curve.push_back({towards.gamma, std::max(0.0, row.measured / towards.per_candela)});
  }
  std::ranges::sort(curve, {}, &RoughPoint::gamma);
  return curve;
}

int DistinctAngles(const std::vector<RoughPoint>& curve) {
  constexpr double kApart = 0.5 * kRadiansPerDegree;
  int count = 0;
  double last = -1.0;
  for (const RoughPoint& point : curve) {
    if (point.gamma < last + kApart) continue;
    last = point.gamma;
    ++count;
  }
  return count;
}

std::vector<int> KinksOf(const std::vector<RoughPoint>& curve, const BeamShape& shape) {
  const auto most = std::ranges::max_element(curve, {}, &RoughPoint::candela);
  std::vector<int> nodes;
  if (most + 1 == curve.end()) return nodes;
  if (most->candela < kHollow * curve.front().candela) return {0};
  for (int k = 2; k < BeamShape::kNodes - 1; ++k) {
    const double gamma = shape.scale * std::sinh(k * shape.step);
    if (gamma > (most - 1)->gamma && gamma < (most + 1)->gamma) nodes.push_back(k);
  }
  return nodes;
}

ReadingSurface SurfaceOf(const std::vector<BeamRow>& rows) {
  std::vector<double> along;
  std::vector<double> whole;
  for (const BeamRow& row : rows) {
    if (!row.lit || !(row.from_lamp[2] > 0.0)) continue;
    along.push_back(row.from_lamp[2]);
    whole.push_back(Length(row.from_lamp));
  }
  if (along.empty()) return {};
  const auto spread = [](const std::vector<double>& metres) {
    const auto [least, most] = std::ranges::minmax(metres);
    return most / least;
  };
  const bool plane = spread(along) <= spread(whole);
  std::vector<double>& metres = plane ? along : whole;
  const double off = spread(metres);
  return {{Median(metres), plane}, off};
}

RoughSmooth SmoothThrough(const std::vector<RoughPoint>& curve, double half_angle, double outermost,
                          const ReadFrom& from) {
  RoughSmooth out{{BeamFamily::kSmooth, from}, {}, 0.0};
  for (const RoughPoint& point : curve) {
    out.peak_cd = std::max(out.peak_cd, point.candela);
    outermost = std::max(outermost, point.gamma);
  }
  out.shape.scale = half_angle;
  const double reach =
      std::clamp(std::max(kReach * outermost, 2.0 * half_angle), 0.01, kQuarterTurn);
  out.shape.step = std::asinh(reach / half_angle) / (BeamShape::kNodes - 1);
  for (int k = 0; k < BeamShape::kNodes; ++k) {
    const double seen = RoughAt(curve, half_angle * std::sinh(k * out.shape.step));
    // Beyond the readings on down from the last.
    out.nodes.push_back(seen >= 0.0 ? BeamShape::LatentOf(seen / out.peak_cd)
                                    : out.nodes.back() - 0.2 * out.shape.step);
  }
  return out;
}

double RoughHalfAngle(const std::vector<BeamRow>& rows) {
  const std::vector<RoughPoint> curve = RoughCurve(rows);
  if (curve.empty()) return 0.35;
  const auto most = std::ranges::max_element(curve, {}, &RoughPoint::candela);
  for (auto i = most + 1; i < curve.end(); ++i) {
    if (i->candela > 0.5 * most->candela) continue;
    const double t = ((i - 1)->candela - 0.5 * most->candela) / ((i - 1)->candela - i->candela);
    return std::max(0.005, (i - 1)->gamma + t * (i->gamma - (i - 1)->gamma));
  }
  // Nothing was seen to fall so far: as a Gaussian through the last.
  const RoughPoint& last = curve.back();
  const double fallen = std::log(most->candela / std::max(last.candela, 1e-300));
  const double farther = std::sqrt(std::numbers::ln2 / std::max(fallen, 0.05));
  return std::clamp(farther * last.gamma, 0.02, 1.3);
}

}  // namespace lightcal::fit
