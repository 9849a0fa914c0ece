// SPDX-License-Identifier: Apache-2.0
#include "brute_force.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace lightcal::test {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr int kOrder = 20;

struct Rule {
  std::array<Real, kOrder> node, weight;
  Rule() {
    for (int i = 0; i < kOrder; ++i) {
      Real x = std::cos(kPi * (static_cast<Real>(i) + 0.75L) / (kOrder + 0.5L));
      Real slope = 0;
      for (int step = 0; step < 50; ++step) {
        Real p0 = 1, p1 = x;
        for (int k = 2; k <= kOrder; ++k) {
          const Real p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
          p0 = p1;
          p1 = p2;
        }
        slope = kOrder * (x * p1 - p0) / (x * x - 1);
        x -= p1 / slope;
      }
      node[i] = x;
      weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};
const Rule& TheRule() {
  static const Rule rule;
  return rule;
}

Real Dot3(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

template <class Function>
Real Panel(const Function& f, Real a, Real b) {
  const Rule& rule = TheRule();
  const Real middle = (a + b) / 2;
  const Real half = (b - a) / 2;
  Real sum = 0;
  for (int i = 0; i < kOrder; ++i) sum += rule.weight[i] * f(middle + half * rule.node[i]);
  return half * sum;
}

// Between a and b, which may hold a peak of a width: panels no longer than their distance from it.
template <class Function>
Real Graded(const Function& f, Real a, Real b, Real peak, Real width) {
  if (!(b > a)) return 0;
  std::vector<Real> cuts = {a, b};
  const auto cut = [&](Real x) {
    if (x > a && x < b) cuts.push_back(x);
  };
  cut(peak);
  const Real reach = std::max(std::abs(a - peak), std::abs(b - peak));
  for (Real step = std::max(width, reach * 1e-12L); step < reach; step *= 2) {
    cut(peak - step);
    cut(peak + step);
  }
  std::sort(cuts.begin(), cuts.end());
  Real sum = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i) sum += Panel(f, cuts[i - 1], cuts[i]);
  return sum;
}

// tanh-sinh: for functions with roots at their ends.
template <class Function>
Real DoubleExponential(const Function& f, Real a, Real b) {
  const Real h = 1.0L / 32;
  const Real middle = (a + b) / 2;
  const Real half = (b - a) / 2;
  Real sum = 0;
  for (int k = -130; k <= 130; ++k) {
    const Real u = kPi / 2 * std::sinh(h * static_cast<Real>(k));
    const Real c = std::cosh(u);
    const Real weight = kPi / 2 * std::cosh(h * static_cast<Real>(k)) / (c * c);
    if (weight < 1e-25L) continue;
    sum += weight * f(middle + half * std::tanh(u));
  }
  return half * h * sum;
}

// Lower and upper y of a convex polygon at x.
std::array<Real, 2> Span(const std::vector<std::array<Real, 2>>& corners, Real x) {
  Real low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& p = corners[i];
    const auto& q = corners[(i + 1) % corners.size()];
    if ((p[0] - x) * (q[0] - x) > 0 || p[0] == q[0]) continue;
    const Real y = p[1] + (q[1] - p[1]) * (x - p[0]) / (q[0] - p[0]);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  return {low, high};
}

// Triangles between the receiver's foot and each edge, signed, in polar coordinates about the foot:
// the peak under a near receiver then sits in every triangle's corner.
Real TrianglesFromFoot(const std::vector<std::array<Real, 2>>& corners, const BruteReceiver& at) {
  const Real3& n = at.normal;
  const Real h = at.position[2];
  Real sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& end = corners[(i + 1) % corners.size()];
    const Real ax = corners[i][0] - at.position[0], ay = corners[i][1] - at.position[1];
    const Real bx = end[0] - at.position[0], by = end[1] - at.position[1];
    const Real length = std::hypot(bx - ax, by - ay);
    if (!(length > 0)) continue;
    const Real ex = (bx - ax) / length, ey = (by - ay) / length;
    const Real off = ax * ey - ay * ex;  // of the edge's line, along (ey, -ex)
    const Real along = n[0] * ex + n[1] * ey, across = n[0] * ey - n[1] * ex;
    const auto ray = [&](Real u) {  // through the line's point `off * u` from its own foot
      const Real secant = std::sqrt(1 + u * u);
      const Real slope = (off > 0 ? across + along * u : -across - along * u) / secant;
      const auto kernel = [&](Real rho) {
        const Real r2 = rho * rho + h * h;
        return (slope * rho - n[2] * h) * h * rho / (r2 * r2);
      };
      return Graded(kernel, 0, std::abs(off) * secant, 0, h) / (secant * secant);
    };
    if (off == 0) continue;
    const Real from = (ax * ex + ay * ey) / off, to = (bx * ex + by * ey) / off;
    const Real part = Graded(ray, std::min(from, to), std::max(from, to), 0,
                             std::min<Real>(0.5L, h / std::abs(off)));
    sum += off > 0 ? part : -part;
  }
  return sum;
}

}  // namespace

Real BrutePolygon(std::vector<std::array<Real, 2>> corners, const BruteReceiver& at) {
  const Real3& p = at.position;
  const Real3& n = at.normal;
  if (!(p[2] > 0)) return 0;
  const auto above = [&](const std::array<Real, 2>& c) {
    return n[0] * (c[0] - p[0]) + n[1] * (c[1] - p[1]) - n[2] * p[2];
  };
  std::vector<std::array<Real, 2>> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    const Real ha = above(a), hb = above(b);
    if (ha > 0) kept.push_back(a);
    if ((ha > 0) != (hb > 0)) {
      const Real t = ha / (ha - hb);
      kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  if (kept.size() < 3) return 0;
  Real size = 0;
  for (const auto& c : kept) size = std::max(size, std::hypot(c[0], c[1]));
  if (std::sqrt(Dot3(p, p)) < 4 * size) return std::abs(TrianglesFromFoot(kept, at));
  std::vector<Real> xs;
  for (const auto& c : kept) xs.push_back(c[0]);
  std::sort(xs.begin(), xs.end());
  const auto row = [&](Real x) {
    const auto [low, high] = Span(kept, x);
    const Real dx = x - p[0];
    const auto kernel = [&](Real y) {
      const Real dy = y - p[1];
      const Real r2 = dx * dx + dy * dy + p[2] * p[2];
      return std::max<Real>(0, n[0] * dx + n[1] * dy - n[2] * p[2]) * p[2] / (r2 * r2);
    };
    return Graded(kernel, low, high, p[1], std::hypot(p[2], dx));
  };
  Real sum = 0;
  for (std::size_t i = 1; i < xs.size(); ++i) {
    if (xs[i] > xs[i - 1]) sum += Graded(row, xs[i - 1], xs[i], p[0], p[2]);
  }
  return sum;
}

Real BruteRect(Real half_width, Real half_height, const BruteReceiver& at) {
  return BrutePolygon({{half_width, half_height},
                       {-half_width, half_height},
                       {-half_width, -half_height},
                       {half_width, -half_height}},
                      at);
}

Real BruteLine(Real half_length, const BruteReceiver& at) {
  const Real3& p = at.position;
  const Real3& n = at.normal;
  const auto above = [&](Real x) { return (x - p[0]) * n[0] - p[1] * n[1] - p[2] * n[2]; };
  const auto kernel = [&](Real x) {
    const Real r2 = (x - p[0]) * (x - p[0]) + p[1] * p[1] + p[2] * p[2];
    return above(x) * p[2] / (r2 * r2);
  };
  Real from = -half_length, to = half_length;
  if (above(from) <= 0 && above(to) <= 0) return 0;
  const Real horizon = n[0] != 0 ? p[0] + (p[1] * n[1] + p[2] * n[2]) / n[0] : 0;
  if (above(from) <= 0) from = horizon;
  if (above(to) <= 0) to = horizon;
  return Graded(kernel, from, to, p[0], std::hypot(p[1], p[2]));
}

Real BruteDisk(Real radius, const BruteReceiver& at) {
  const Real3& p = at.position;
  const Real3& n = at.normal;
  if (!(p[2] > 0)) return 0;
  const Real slope = std::hypot(n[0], n[1]);
  const Real ux = slope > 0 ? n[0] / slope : 1, uy = slope > 0 ? n[1] / slope : 0;
  // Coordinates along u and across, of the receiver's foot and of the horizon.
  const Real fu = p[0] * ux + p[1] * uy;
  const Real fw = -p[0] * uy + p[1] * ux;
  const Real center = -Dot3(n, p);
  Real end = kPi;
  if (center < slope * radius) {
    if (center <= -slope * radius) return 0;
    end = std::acos(-center / (slope * radius));
  }
  const auto row = [&](Real t) {
    const Real u = radius * std::cos(t);
    const Real half = radius * std::sin(t);
    const Real du = u - fu;
    const Real above = std::max<Real>(0, center + slope * u);
    const auto kernel = [&](Real w) {
      const Real dw = w - fw;
      const Real r2 = du * du + dw * dw + p[2] * p[2];
      return above * p[2] / (r2 * r2);
    };
    return half * Graded(kernel, -half, half, fw, std::hypot(p[2], du));
  };
  const Real foot = std::clamp<Real>(fu / radius, -1, 1);
  const Real peak = std::acos(foot);
  const Real out = std::max<Real>(0, std::abs(fu) - radius);
  return Graded(row, 0, end, peak, std::hypot(p[2], out) / radius / 2);
}

Real BruteSphere(Real radius, const BruteReceiver& at) {
  const Real d = std::sqrt(Dot3(at.position, at.position));
  const Real s = radius / d;
  const Real cr = -Dot3(at.normal, at.position) / d;
  const Real st = std::sqrt(std::max<Real>(0, (1 - cr) * (1 + cr)));
  const auto ring = [&](Real t) {  // sin t int max(0, cr cos t + st sin t cos f) df
    const Real a = cr * std::cos(t), b = st * std::sin(t);
    if (a >= b) return std::sin(t) * 2 * kPi * a;
    if (a <= -b) return Real(0);
    const Real f = std::acos(-a / b);
    return std::sin(t) * 2 * Panel([&](Real x) { return a + b * std::cos(x); }, 0, f);
  };
  const Real end = std::asin(s);
  const Real bend = std::atan2(std::abs(cr), st);
  if (bend >= end) return DoubleExponential(ring, 0, end);
  return DoubleExponential(ring, 0, bend) + DoubleExponential(ring, bend, end);
}

Real BruteTube(Real half_length, Real radius, const BruteReceiver& at) {
  const Real3& p = at.position;
  const Real3& n = at.normal;
  const Real away = std::hypot(p[1], p[2]);
  if (away <= radius) return 0;
  const Real limit = std::acos(radius / away);
  const Real facing = std::atan2(p[2], p[1]);
  const auto strip = [&](Real f) {
    const Real3 m = {0, std::cos(facing + f), std::sin(facing + f)};
    const Real3 v = {0, radius * m[1] - p[1], radius * m[2] - p[2]};
    const Real toward = -(m[1] * v[1] + m[2] * v[2]);
    if (!(toward > 0)) return Real(0);
    const Real rho2 = v[1] * v[1] + v[2] * v[2];
    const Real base = n[1] * v[1] + n[2] * v[2];
    Real low = -half_length, high = half_length;
    const Real at_low = base + n[0] * (low - p[0]), at_high = base + n[0] * (high - p[0]);
    if (at_low <= 0 && at_high <= 0) return Real(0);
    if (at_low < 0) low = p[0] - base / n[0];
    if (at_high < 0) high = p[0] - base / n[0];
    const auto kernel = [&](Real x) {
      const Real t = x - p[0];
      const Real r2 = rho2 + t * t;
      return std::max<Real>(0, base + n[0] * t) * toward / (r2 * r2);
    };
    return radius * Graded(kernel, low, high, p[0], std::sqrt(rho2));
  };
  // The horizon passes an end where base + n0 (end - p0) = 0: a bend of `strip`.
  std::vector<Real> cuts = {-limit, limit};
  const Real radial = std::hypot(n[1], n[2]);
  if (radial > 0) {
    // Where it passes near the receiver's own foot the strips' ends move fast.
    std::vector<Real> ends = {-half_length, half_length, p[0]};
    for (Real step = away - radius; step < 2 * half_length + std::abs(p[0]); step *= 2) {
      for (const Real x : {p[0] - step, p[0] + step}) {
        if (std::abs(x) < half_length) ends.push_back(x);
      }
    }
    for (const Real end : ends) {
      const Real c = (n[1] * p[1] + n[2] * p[2] - n[0] * (end - p[0])) / (radius * radial);
      if (std::abs(c) >= 1) continue;
      for (const Real sign : {-1.0L, 1.0L}) {
        for (int turn = -2; turn <= 2; ++turn) {
          const Real f = std::atan2(n[2], n[1]) + sign * std::acos(c) - facing + 2 * kPi * turn;
          if (std::abs(f) < limit) cuts.push_back(f);
        }
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  Real sum = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    sum += Graded(strip, cuts[i - 1], cuts[i], 0, (away - radius) / std::sqrt(radius * away) / 2);
  }
  return sum;
}

}  // namespace lightcal::test
