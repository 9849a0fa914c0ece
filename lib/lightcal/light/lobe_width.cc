// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/intensity_table.h"

namespace lightcal {
namespace {

constexpr int kSteps = 1800;  // of a half-plane; lobes narrower than 0.2 degrees may be missed

// The direction a lobe is measured about, and two across it.
struct Axes {
  Vec3 along, c0, c90;
};
Axes AxesOf(const IntensityTable& table) {
  const double up = table.peak().gamma.value() > 0.5 * std::numbers::pi ? 1.0 : -1.0;
  return {{0.0, 0.0, up}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
}

Vec3 TowardsPeak(const IntensityTable& table) {
  const double c = table.peak().c.value();
  const double gamma = table.peak().gamma.value();
  return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)};
}

// One half-plane, seen outwards from that direction.
class HalfPlane {
 public:
  HalfPlane(const IntensityTable& table, const Axes& axes, double c, TableInterpolation way)
      : table_(table),
        way_(way),
        along_(axes.along),
        out_(axes.c0 * std::cos(c) + axes.c90 * std::sin(c)) {}

  [[nodiscard]] double At(double out) const {
    return table_.Towards(along_ * std::cos(out) + out_ * std::sin(out), way_).value();
  }

  // Where the intensity last falls below `limit` beyond its maximum; 0 where it never reaches it.
  [[nodiscard]] double EdgeAt(double limit) const {
    const auto angle = [](int step) { return std::numbers::pi * step / kSteps; };
    int top = 0;
    double most = At(0.0);
    for (int i = 1; i <= kSteps; ++i) {
      const double here = At(angle(i));
      if (!(here > most * (1.0 + 1e-12))) continue;
      top = i;
      most = here;
    }
    if (most < limit) return 0.0;
    int below = top;
    while (below <= kSteps && At(angle(below)) >= limit) ++below;
    if (below > kSteps) return std::numbers::pi;
    double low = angle(below - 1);
    double high = angle(below);
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (At(middle) >= limit ? low : high) = middle;
    }
    return low;
  }

 private:
  const IntensityTable& table_;
  TableInterpolation way_;
  Vec3 along_{};
  Vec3 out_{};
};

double WidthAbout(const IntensityTable& table, const Axes& axes, double c, double limit,
                  TableInterpolation way = TableInterpolation::kLinear) {
  return HalfPlane(table, axes, c, way).EdgeAt(limit) +
         HalfPlane(table, axes, c + std::numbers::pi, way).EdgeAt(limit);
}

// Whether the lamp shines beside its axis alone: neither the axis nor the direction opposite to the
// peak about it (of a batwing the other wing) has half the peak.
bool ShinesBeside(const IntensityTable& table, const Axes& axes) {
  const double half = 0.5 * table.peak().intensity.value();
  const Vec3 peak = TowardsPeak(table);
  const Vec3 opposite = axes.along * (2.0 * Dot(peak, axes.along)) - peak;
  return table.Towards(axes.along).value() < half && table.Towards(opposite).value() < half;
}

// About the middle of what is as bright as the peak: c0 leads away from the lamp's axis, c90
// across.
Axes AxesOfPeak(const IntensityTable& table, const Axes& lamp) {
  const double top = table.peak().intensity.value() * (1.0 - 1e-9);
  const auto about = [&](const Vec3& peak) -> Axes {
    const Vec3 across = Cross(lamp.along, peak);
    const Vec3 c90 = across * (1.0 / Length(across));
    return {peak, Cross(c90, peak), c90};
  };
  Axes axes = about(TowardsPeak(table));
  for (const double c : {0.0, 0.5 * std::numbers::pi}) {
    const double out = HalfPlane(table, axes, c, TableInterpolation::kLinear).EdgeAt(top);
    const double back =
        HalfPlane(table, axes, c + std::numbers::pi, TableInterpolation::kLinear).EdgeAt(top);
    const double turn = 0.5 * (out - back);
    const Vec3 side = c == 0.0 ? axes.c0 : axes.c90;
    axes = about(axes.along * std::cos(turn) + side * std::sin(turn));
  }
  return axes;
}

// Which way an oblong lobe lies about the axis: the phase of its width's second harmonic in C,
//   w(c) = mean + A cos 2 (c - turn) + ...,
// C0 where it is as good as round, or as good as along its file's planes.
double TurnOf(const IntensityTable& table, const Axes& axes, double limit) {
  constexpr int kPlanes = 24;           // of half a turn: of any smooth outline, no alias
  constexpr double kRound = 0.01;       // of the mean; files' own noise makes as much
  constexpr double kLeastTurn = 0.022;  // rad, half the gap between planes of 2.5 degrees
  double mean = 0.0, even = 0.0, odd = 0.0;
  for (int i = 0; i < kPlanes; ++i) {
    const double c = std::numbers::pi * i / kPlanes;
    const double width = WidthAbout(table, axes, c, limit);
    mean += width / kPlanes;
    even += 2.0 / kPlanes * width * std::cos(2.0 * c);
    odd += 2.0 / kPlanes * width * std::sin(2.0 * c);
  }
  if (2.0 * std::hypot(even, odd) < kRound * mean) return 0.0;
  // Of both planes the one nearer to C0; half-way between them the widest.
  constexpr double kQuarter = 0.25 * std::numbers::pi;
  const double widest = 0.5 * std::atan2(odd, even);
  const double turn =
      std::abs(widest) < kQuarter + 1e-3 ? widest : std::remainder(widest, 2.0 * kQuarter);
  return std::abs(turn) < kLeastTurn ? 0.0 : turn;
}

}  // namespace

Radians LobeWidth(const IntensityTable& table, Radians c, double level, TableInterpolation way) {
  const double limit = level * table.peak().intensity.value();
  return Radians(WidthAbout(table, AxesOf(table), c.value(), limit, way));
}

LobeWidths LobeWidthsAt(const IntensityTable& table, double level) {
  const Axes axes = AxesOf(table);
  const double limit = level * table.peak().intensity.value();
  if (table.symmetry() == TableSymmetry::kAxial) {  // all half-planes are alike
    const HalfPlane any(table, axes, 0.0, TableInterpolation::kLinear);
    // No node is dark, and neither is what lies beyond the last: a table may end at 90 degrees.
    const bool everywhere = table.least_cd() > limit && any.At(std::numbers::pi) > limit;
    const double edge = everywhere ? std::numbers::pi : any.EdgeAt(limit);
    const Radians whole(2.0 * edge);
    return {whole, whole, whole};
  }
  const bool beside = ShinesBeside(table, axes);
  const Axes about = beside ? AxesOfPeak(table, axes) : axes;
  const double turn = beside ? 0.0 : TurnOf(table, axes, limit);
  const Radians along(WidthAbout(table, about, turn, limit));
  const Radians across(WidthAbout(table, about, turn + 0.5 * std::numbers::pi, limit));
  return {0.5 * (along + across), along, across, beside, Radians(turn)};
}

}  // namespace lightcal
