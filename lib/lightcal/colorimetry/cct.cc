// SPDX-License-Identifier: Apache-2.0
// The locus of locus_table.h, searched by the sign of the tangential projection (no distances:
// (d1^2 - d2^2) cancels) and finished by Newton.
#include "lightcal/colorimetry/cct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include "lightcal/colorimetry/locus_table.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {

using locus::Curve;
using locus::kColdestKelvin;
using locus::kDuvLimit;
using locus::kInfinityMireds;
using locus::kSegments;
using locus::kStepMireds;
using locus::Locus;
using locus::LocusTable;
using locus::Segment;

namespace {

constexpr int kLargestStep =
    256;  // of the binary search: a power of two, twice it at least kSegments

// Beyond this distance another branch of the locus may be nearer; its least radius of curvature is
// 0.1001 (at 5192 K), within which the nearest point is unique.
constexpr double kUniqueWithin = 0.08;

// A stationary point of the distance to the locus.
struct Nearest {
  int segment = 0;
  double t = 0.0;    // within the segment
  double duv = 0.0;  // normal component
  double distance = 0.0;
  [[nodiscard]] double InMireds() const { return (segment + t) * kStepMireds; }
};

Nearest Describe(const LocusTable& locus, int segment, double t, Uv1960 p) {
  const Curve c = locus.SegmentAt(segment).At(t);
  const double eu = p.u - c.u;
  const double ev = p.v - c.v;
  const double speed = std::sqrt(c.du * c.du + c.dv * c.dv);
  return {segment, t, (ev * c.du - eu * c.dv) / speed, std::sqrt(eu * eu + ev * ev)};
}

// Half the second derivative of the squared distance: what a Newton step divides by.
double Stiffness(const Curve& c, Uv1960 p) {
  return c.du * c.du + c.dv * c.dv + (c.u - p.u) * c.d2u + (c.v - p.v) * c.d2v;
}

double NewtonStep(const Curve& c, Uv1960 p) {
  return -((c.u - p.u) * c.du + (c.v - p.v) * c.dv) / Stiffness(c, p);
}

// Where the straight line between the projections at the two ends crosses zero.
double FirstGuess(const LocusTable& locus, int segment, Uv1960 p) {
  const double ahead = locus.NodeAt(segment).Ahead(p);
  const double behind = locus.NodeAt(segment + 1).Ahead(p);
  return ahead > behind ? std::clamp(ahead / (ahead - behind), 0.0, 1.0) : 0.5;
}

// The last segment whose start still points ahead (the first when none does): a search that cuts
// its range in four a round, without a branch to mispredict and with three projections side by
// side.
int LastSegmentAhead(const LocusTable& locus, Uv1960 p) {
  int low = 0;
  const auto ahead = [&](int node) {
    return static_cast<int>(locus.NodeAt(std::min(node, kSegments)).Ahead(p) > 0.0);
  };
  for (int step = kLargestStep; step > 0; step /= 4) {
    low += step * (ahead(low + step) + ahead(low + 2 * step) + ahead(low + 3 * step));
  }
  return std::min(low, kSegments - 1);
}

// Near the locus: the projection falls monotonically, two Newton steps reach rounding.
Nearest NearestByBisection(const LocusTable& locus, Uv1960 p) {
  const int segment = LastSegmentAhead(locus, p);
  const Segment& s = locus.SegmentAt(segment);
  double t = FirstGuess(locus, segment, p);
  for (int i = 0; i < 2; ++i) t = std::clamp(t + NewtonStep(s.At(t), p), 0.0, 1.0);
  return Describe(locus, segment, t, p);
}

// One segment whose ends pull towards its inside: Newton, safeguarded by bisection.
Nearest NearestInSegment(const LocusTable& locus, int segment, Uv1960 p) {
  const Segment& s = locus.SegmentAt(segment);
  double low = 0.0;
  double high = 1.0;
  double t = FirstGuess(locus, segment, p);
  for (int i = 0; i < 60; ++i) {
    const Curve c = s.At(t);
    ((c.u - p.u) * c.du + (c.v - p.v) * c.dv > 0.0 ? high : low) = t;
    double next = t + NewtonStep(c, p);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - t) < 1e-15) break;
    t = next;
  }
  return Describe(locus, segment, t, p);
}

// Far from the locus: every local minimum, and both ends.
Nearest NearestByScan(const LocusTable& locus, Uv1960 p) {
  Nearest best = Describe(locus, 0, 0.0, p);
  const auto consider = [&best](const Nearest& candidate) {
    if (candidate.distance < best.distance) best = candidate;
  };
  consider(Describe(locus, kSegments - 1, 1.0, p));
  double ahead = locus.NodeAt(0).Ahead(p);
  for (int i = 0; i < kSegments; ++i) {
    const double next_ahead = locus.NodeAt(i + 1).Ahead(p);
    if (ahead > 0.0 && next_ahead <= 0.0) consider(NearestInSegment(locus, i, p));
    ahead = next_ahead;
  }
  return best;
}

Nearest NearestOnLocus(const LocusTable& locus, Uv1960 p) {
  const Nearest nearest = NearestByBisection(locus, p);
  return nearest.distance < kUniqueWithin ? nearest : NearestByScan(locus, p);
}

// Finite, with y > 0 and on the colours' side of the pole of u, v <-> x, y.
bool IsChromaticity(Uv1960 uv) {
  return std::isfinite(uv.u) && std::isfinite(uv.v) && uv.v > 0.0 &&
         2.0 * uv.u - 8.0 * uv.v + 4.0 > 0.0;
}
bool IsChromaticity(Xy xy) {
  return std::isfinite(xy.x) && std::isfinite(xy.y) && xy.y > 0.0 &&
         -2.0 * xy.x + 12.0 * xy.y + 3.0 > 0.0;
}

// The exact locus at the temperatures lately asked for: every engine of every preset and every row
// of a report asks for the same few, at 471 exponentials each.
const LocusPoint& LatelyAsked(Mireds reciprocal) {
  struct Asked {
    double mireds = -1.0;
    LocusPoint at;
  };
  constexpr std::size_t kKept = 64;
  thread_local std::array<Asked, kKept> kept;
  const double mireds = reciprocal.value();
  Asked& place = kept[std::hash<double>()(mireds) % kKept];
  if (place.mireds != mireds) place = {mireds, PlanckianLocusAt(reciprocal)};
  return place.at;
}

}  // namespace

std::string DuvText(double duv) {
  constexpr double kNone = 1e-6;
  return RoundedText(std::abs(duv) < kNone ? 0.0 : duv, 2);
}

CctResult CctFromUv(Uv1960 uv) {
  CctResult result;
  if (!IsChromaticity(uv)) return result;
  const Nearest nearest = NearestOnLocus(Locus(), uv);
  result.duv = nearest.duv;
  if (nearest.InMireds() < kInfinityMireds) {
    result.temperature = Kelvin(std::numeric_limits<double>::infinity());
    result.status = CctStatus::kBeyondInfinity;
    return result;
  }
  result.temperature = KelvinFromMireds(Mireds(nearest.InMireds()));
  if (nearest.distance > kDuvLimit) {
    result.status = CctStatus::kFarFromLocus;
  } else if (result.temperature.value() < kColdestKelvin) {
    result.status = CctStatus::kBelowRange;
  } else {
    result.status = CctStatus::kOk;
  }
  return result;
}

CctResult CctFromXy(Xy xy) {
  return IsChromaticity(xy) ? CctFromUv(Uv1960FromXy(xy)) : CctResult{};
}

std::optional<CctJacobian> CctJacobianAt(Xy xy) {
  if (!IsChromaticity(xy)) return std::nullopt;
  const Uv1960 uv = Uv1960FromXy(xy);
  const Nearest nearest = NearestOnLocus(Locus(), uv);
  if (nearest.InMireds() < kInfinityMireds) return std::nullopt;
  const Curve c = Locus().SegmentAt(nearest.segment).At(nearest.t);
  const double speed2 = c.du * c.du + c.dv * c.dv;
  const double stiffness = Stiffness(c, uv);
  if (!(stiffness > 1e-9 * speed2)) return std::nullopt;
  const double speed = std::sqrt(speed2);
  const double dmired_du = kStepMireds * c.du / stiffness;
  const double dmired_dv = kStepMireds * c.dv / stiffness;
  const double dduv_du = -c.dv / speed;
  const double dduv_dv = c.du / speed;
  // Derivatives of u = 4x/D, v = 6y/D, D = -2x + 12y + 3.
  const double d2 = std::pow(-2.0 * xy.x + 12.0 * xy.y + 3.0, 2);
  const double du_dx = (48.0 * xy.y + 12.0) / d2;
  const double du_dy = -48.0 * xy.x / d2;
  const double dv_dx = 12.0 * xy.y / d2;
  const double dv_dy = (18.0 - 12.0 * xy.x) / d2;
  return CctJacobian{dmired_du * du_dx + dmired_dv * dv_dx, dmired_du * du_dy + dmired_dv * dv_dy,
                     dduv_du * du_dx + dduv_dv * dv_dx, dduv_du * du_dy + dduv_dv * dv_dy};
}

CctUncertainty PropagateToCct(const CctJacobian& j, const XyCovariance& c) {
  const auto product = [&c](double ax, double ay, double bx, double by) {
    return ax * bx * c.xx + (ax * by + ay * bx) * c.xy + ay * by * c.yy;
  };
  const double mired2 = product(j.dmired_dx, j.dmired_dy, j.dmired_dx, j.dmired_dy);
  const double duv2 = product(j.dduv_dx, j.dduv_dy, j.dduv_dx, j.dduv_dy);
  return {Mireds(std::sqrt(std::max(0.0, mired2))), std::sqrt(std::max(0.0, duv2)),
          product(j.dmired_dx, j.dmired_dy, j.dduv_dx, j.dduv_dy)};
}

Uv1960 UvFromCct(Kelvin temperature, double duv) {
  const LocusPoint& at = LatelyAsked(MiredsFromKelvin(temperature));
  const double speed = std::hypot(at.du, at.dv);
  return {at.uv.u - duv * at.dv / speed, at.uv.v + duv * at.du / speed};
}

Xy XyFromCct(Kelvin temperature, double duv) { return XyFromUv1960(UvFromCct(temperature, duv)); }

}  // namespace lightcal
