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
  if (table.grid().type == GoniometerType::kA) {
    return {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
  }
  const double up = table.peak().gamma.value() > 0.5 * std::numbers::pi ? 1.0 : -1.0;
  return {{0.0, 0.0, up}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
}

// One half-plane, seen outwards from that direction.
class HalfPlane {
 public:
  HalfPlane(const IntensityTable& table, double c, TableInterpolation way)
      : table_(table), way_(way) {
    const Axes axes = AxesOf(table);
    along_ = axes.along;
    out_ = axes.c0 * std::cos(c) + axes.c90 * std::sin(c);
  }

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

}  // namespace

Radians LobeWidth(const IntensityTable& table, Radians c, double level, TableInterpolation way) {
  const double limit = level * table.peak().intensity.value();
  return Radians(HalfPlane(table, c.value(), way).EdgeAt(limit) +
                 HalfPlane(table, c.value() + std::numbers::pi, way).EdgeAt(limit));
}

LobeWidths LobeWidthsAt(const IntensityTable& table, double level) {
  if (table.symmetry() == TableSymmetry::kAxial) {  // all half-planes are alike
    const double limit = level * table.peak().intensity.value();
    const HalfPlane any(table, 0.0, TableInterpolation::kLinear);
    // No node is dark, and neither is what lies beyond the last: a table may end at 90 degrees.
    const bool everywhere = table.least_cd() > limit && any.At(std::numbers::pi) > limit;
    const double edge = everywhere ? std::numbers::pi : any.EdgeAt(limit);
    const Radians whole(2.0 * edge);
    return {whole, whole, whole};
  }
  const Radians c0 = LobeWidth(table, Radians(0.0), level);
  const Radians c90 = LobeWidth(table, Radians(0.5 * std::numbers::pi), level);
  return {0.5 * (c0 + c90), c0, c90};
}

}  // namespace lightcal
