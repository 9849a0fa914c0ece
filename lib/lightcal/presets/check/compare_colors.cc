// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/compare_colors.h"

#include <algorithm>
#include <cmath>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/presets/light_color.h"

namespace lightcal {
namespace {

// Half of what two lamps side by side show; files round by less, Godot's tint is of another black
// body by less.
constexpr double kRounding_uv = 0.002;

double Apart(const Uv1976& a, const Uv1976& b) { return std::hypot(a.u - b.u, a.v - b.v); }

// Absent of black.
std::optional<Uv1976> UvOfRgb(const Rgb& linear) {
  const Xyz xyz = XyzFromLinearRgb(linear, RgbSpace::kSrgb);
  return xyz.Y > 0.0 ? std::optional(Uv1976FromXy(XyFromXyz(xyz))) : std::nullopt;
}

// From a point to the nearest of a straight way.
double ApartFromWay(const Uv1976& at, const Uv1976& from, const Uv1976& to) {
  const double du = to.u - from.u, dv = to.v - from.v;
  const double length2 = du * du + dv * dv;
  const double along =
      length2 > 0.0 ? std::clamp(((at.u - from.u) * du + (at.v - from.v) * dv) / length2, 0.0, 1.0)
                    : 0.0;
  return Apart(at, {from.u + along * du, from.v + along * dv});
}

}  // namespace

double ColorU95(const std::optional<Uncertain>& cct_K, const std::optional<Uncertain>& duv) {
  double u95 = 0.0;
  const double off = duv ? duv->value : 0.0;
  if (cct_K && LowEnd(*cct_K) > 0.0) {
    const auto at = [&](double kelvin) { return Uv1976FromXy(XyFromCct(Kelvin(kelvin), off)); };
    const Uv1976 middle = at(cct_K->value);
    u95 = std::max(Apart(at(LowEnd(*cct_K)), middle), Apart(at(HighEnd(*cct_K)), middle));
  }
  constexpr double kUv1976PerDuv = 1.5;  // v' = 1.5 v
  return std::hypot(u95, duv ? kUv1976PerDuv * duv->u95 : 0.0);
}

std::vector<ComparedColor> CompareColors(const LightFile& lamps,
                                         const std::vector<EngineLight>& lights,
                                         std::optional<Xy> white) {
  std::vector<ComparedColor> rows;
  for (const FittedLight& lamp : lamps.lights) {
    Warnings said_by_export;
    const EmittedColor color = ColorOfLight(lamp, {RgbSpace::kSrgb, white}, said_by_export);
    const auto own = UvOfRgb(color.unit_luminance);
    const auto clipped = UvOfRgb(color.max_normalised);
    if (!color.xy || !own || !clipped) continue;
    for (const EngineLight& light : lights) {
      const bool stands_for =
          light.name.empty() ? light.kind == EngineLightKind::kDome && lamp.kind == LightKind::kDome
                             : light.name == lamp.name;
      const auto at =
          light.rgb ? UvOfRgb({(*light.rgb)[0], (*light.rgb)[1], (*light.rgb)[2]}) : std::nullopt;
      if (!stands_for || !at) continue;
      rows.push_back({lamp.name, *color.xy, ApartFromWay(*at, *own, *clipped),
                      ColorU95(lamp.color.cct_K, lamp.color.duv) + kRounding_uv});
    }
  }
  return rows;
}

}  // namespace lightcal
