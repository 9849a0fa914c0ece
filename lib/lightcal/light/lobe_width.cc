// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/intensity_table.h"

namespace lightcal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSteps = 1800;  // of a half-plane; lobes narrower than 0.2 degrees may be missed

// One half-plane, seen outwards from the pole the lamp shines at.
class HalfPlane {
 public:
  HalfPlane(const IntensityTable& table, double c, TableInterpolation way)
      : table_(table), c_(c), way_(way), from_behind_(table.peak().gamma.value() > 0.5 * kPi) {}

  [[nodiscard]] double At(double out) const {
    const double gamma = from_behind_ ? kPi - out : out;
    return table_.At(Radians(c_), Radians(gamma), way_).value();
  }

  // Where the intensity last falls below `limit` beyond its maximum; 0 where it never reaches it.
  [[nodiscard]] double EdgeAt(double limit) const {
    const auto angle = [](int step) { return kPi * step / kSteps; };
    int top = 0;
    for (int i = 1; i <= kSteps; ++i) {
      if (At(angle(i)) > At(angle(top)) * (1.0 + 1e-12)) top = i;
    }
    if (At(angle(top)) < limit) return 0.0;
    int below = top;
    while (below <= kSteps && At(angle(below)) >= limit) ++below;
    if (below > kSteps) return kPi;
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
  double c_;
  TableInterpolation way_;
  bool from_behind_;
};

}  // namespace

Radians LobeWidth(const IntensityTable& table, Radians c, double level, TableInterpolation way) {
  const double limit = level * table.peak().intensity.value();
  return Radians(HalfPlane(table, c.value(), way).EdgeAt(limit) +
                 HalfPlane(table, c.value() + kPi, way).EdgeAt(limit));
}

LobeWidths LobeWidthsAt(const IntensityTable& table, double level) {
  const Radians c0 = LobeWidth(table, Radians(0.0), level);
  const Radians c90 = LobeWidth(table, Radians(0.5 * kPi), level);
  return {0.5 * (c0 + c90), c0, c90};
}

}  // namespace lightcal
