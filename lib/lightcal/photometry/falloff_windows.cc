// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/falloff_windows.h"

#include <algorithm>
#include <cmath>

namespace lightcal {
namespace {

constexpr double kSquareCentimetre = 1e-4;  // m^2
constexpr double kShortestDistance = 1e-4;  // m

double Square(double x) { return x * x; }

}  // namespace

double RangeWindow(Metres d, Metres r) {
  if (r <= Metres(0.0) || std::isinf(r.value())) return 1.0;
  const double ratio = d / r;
  if (std::abs(ratio) >= 1.0) return 0.0;
  return 1.0 - Square(Square(ratio));
}

double FilamentFalloff(Metres d, Metres r) {
  return Square(RangeWindow(d, r)) / std::max(Square(d.value()), kSquareCentimetre);
}

double UnityHdrpFalloff(Metres d, Metres r, bool range_attenuation) {
  const double window = RangeWindow(d, r);
  const double kept = range_attenuation ? Square(window) : (window > 0.0 ? 1.0 : 0.0);
  return kept * Square(1.0 / std::max(std::abs(d.value()), 0.01));
}

double ThreeJsFalloff(Metres d, Metres r, double decay) {
  return Square(RangeWindow(d, r)) / std::max(std::pow(std::abs(d.value()), decay), 0.01);
}

double GodotFalloff(Metres d, Metres r, double decay) {
  return Square(RangeWindow(d, r)) *
         std::pow(std::max(std::abs(d.value()), kShortestDistance), -decay);
}

double GltfFalloff(Metres d, Metres r) {
  return RangeWindow(d, r) / Square(std::max(std::abs(d.value()), kShortestDistance));
}

double UnrealFalloff(Metres d, Metres r) {
  return Square(RangeWindow(d, r)) / (Square(d.value()) + kSquareCentimetre);
}

Metres RangeForLoss(Metres d_max, double loss, WindowPower power) {
  // 1 - sqrt(1 - x) = x / (1 + sqrt(1 - x)) keeps its digits for a small loss.
  const double fourth_power =
      power == WindowPower::kPlain ? loss : loss / (1.0 + std::sqrt(1.0 - loss));
  return d_max / std::sqrt(std::sqrt(fourth_power));
}

}  // namespace lightcal
