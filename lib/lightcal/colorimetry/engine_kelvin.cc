// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/engine_kelvin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/planckian.h"

namespace lightcal {
namespace {

constexpr double kColdestEngineKelvin = 1000.0;
constexpr double kHottestEngineKelvin = 15000.0;
constexpr double kTintPerUv = -3000.0;

Rgb Rec709AtUnitY(Uv1960 uv) { return LinearSrgbFromXyz(XyzFromXyAtUnitY(XyFromUv1960(uv))); }

Rgb WithoutNegatives(const Rgb& c) {
  return {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)};
}

Uv1960 ClampedKrystekUv(Kelvin temperature) {
  return KrystekUv(
      Kelvin(std::clamp(temperature.value(), kColdestEngineKelvin, kHottestEngineKelvin)));
}

struct Isotherm {
  double mireds, u, v, du, dv;  // du, dv: along the locus, length 1
};
constexpr std::size_t kIsotherms = 31;

// Robertson's mireds: 0, 10 .. 100, 125 .. 600.
const std::array<Isotherm, kIsotherms>& Isotherms() {
  static const auto lines = [] {
    std::array<Isotherm, kIsotherms> all{};
    for (std::size_t i = 0; i < kIsotherms; ++i) {
      const double n = static_cast<double>(i);
      const double mireds = n <= 10.0 ? 10.0 * n : 100.0 + 25.0 * (n - 10.0);
      const LocusPoint at = PlanckianLocusAt(Mireds(mireds));
      const double speed = std::hypot(at.du, at.dv);
      all[i] = {mireds, at.uv.u, at.uv.v, at.du / speed, at.dv / speed};
    }
    return all;
  }();
  return lines;
}

// Distance of the colour from the isotherm, positive while it is colder.
double Ahead(const Isotherm& line, Uv1960 c) {
  return (c.u - line.u) * line.du + (c.v - line.v) * line.dv;
}

}  // namespace

Uv1960 KrystekUv(Kelvin temperature) {
  const double t = temperature.value();
  return {(0.860117757 + t * (1.54118254e-4 + t * 1.28641212e-7)) /
              (1.0 + t * (8.42420235e-4 + t * 7.08145163e-7)),
          (0.317398726 + t * (4.22806245e-5 + t * 4.20481691e-8)) /
              (1.0 + t * (-2.89741816e-5 + t * 1.61456053e-7))};
}

Rgb KrystekRgbAtUnitY(Kelvin temperature) { return Rec709AtUnitY(ClampedKrystekUv(temperature)); }

Rgb KrystekRgbAtUnitPeak(Kelvin temperature) {
  const Rgb c = WithoutNegatives(Rec709AtUnitY(ClampedKrystekUv(temperature)));
  const double greatest = std::max({c.r, c.g, c.b});
  return {c.r / greatest, c.g / greatest, c.b / greatest};
}

Rgb PlanckianRgbAtUnitY(Kelvin temperature) {
  return WithoutNegatives(Rec709AtUnitY(UvFromCct(temperature)));
}

std::optional<Kelvin> KrystekKelvinFrom(Uv1960 color) {
  const auto distance2 = [color](double mireds) {
    const Uv1960 at = KrystekUv(KelvinFromMireds(Mireds(mireds)));
    return (at.u - color.u) * (at.u - color.u) + (at.v - color.v) * (at.v - color.v);
  };
  constexpr double kHot = 1e6 / kHottestEngineKelvin;
  constexpr double kCold = 1e6 / kColdestEngineKelvin;
  constexpr int kSteps = 200;
  constexpr double kStep = (kCold - kHot) / kSteps;
  int nearest = 0;
  for (int i = 1; i <= kSteps; ++i) {
    if (distance2(kHot + i * kStep) < distance2(kHot + nearest * kStep)) nearest = i;
  }
  if (nearest == 0 || nearest == kSteps) return std::nullopt;
  double low = kHot + (nearest - 1) * kStep;
  double high = kHot + (nearest + 1) * kStep;
  for (int i = 0; i < 80; ++i) {  // ternary search: one minimum between two neighbours
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (distance2(a) < distance2(b) ? high : low) = distance2(a) < distance2(b) ? b : a;
  }
  return KelvinFromMireds(Mireds((low + high) / 2.0));
}

std::optional<AdobeReadout> AdobeReadoutFrom(Uv1960 color) {
  if (!CctFromUv(color).valid()) return std::nullopt;
  const auto& lines = Isotherms();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double before = Ahead(lines[i - 1], color);
    const double after = Ahead(lines[i], color);
    if (!(before > 0.0 && after <= 0.0)) continue;
    const Isotherm& a = lines[i - 1];
    const Isotherm& b = lines[i];
    const double share = before / (before - after);
    const double mireds = a.mireds + share * (b.mireds - a.mireds);
    const double du = a.du + share * (b.du - a.du);
    const double dv = a.dv + share * (b.dv - a.dv);
    const double u = a.u + share * (b.u - a.u);
    const double v = a.v + share * (b.v - a.v);
    const double offset = ((color.v - v) * du - (color.u - u) * dv) / std::hypot(du, dv);
    return AdobeReadout{KelvinFromMireds(Mireds(mireds)), kTintPerUv * offset};
  }
  return std::nullopt;
}

}  // namespace lightcal
