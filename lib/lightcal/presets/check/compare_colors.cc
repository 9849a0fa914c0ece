// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/compare_colors.h"

#include <algorithm>
#include <cmath>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/presets/light_color.h"

namespace lightcal {
namespace {

// Half of what two lamps side by side show; files round by less, Godot's tint is of another black
// body by less.
constexpr double kRounding_uv = 0.002;

struct Place {
  double u = 0.0, v = 0.0;
};

double Apart(const Place& a, const Place& b) { return std::hypot(a.u - b.u, a.v - b.v); }

Place PlaceOfXy(const Xy& xy) {
  const double sum = -2.0 * xy.x + 12.0 * xy.y + 3.0;
  return {4.0 * xy.x / sum, 9.0 * xy.y / sum};
}

// Of linear Rec. 709, by the primaries' own matrix (IEC 61966-2-1); absent of black.
std::optional<Place> PlaceOfRgb(const Vec3& rgb) {
  const double x = 0.4123908 * rgb[0] + 0.3575843 * rgb[1] + 0.1804808 * rgb[2];
  const double y = 0.2126390 * rgb[0] + 0.7151687 * rgb[1] + 0.0721923 * rgb[2];
  const double z = 0.0193308 * rgb[0] + 0.1191948 * rgb[1] + 0.9505322 * rgb[2];
  const double sum = x + 15.0 * y + 3.0 * z;
  if (!(sum > 0.0)) return std::nullopt;
  return Place{4.0 * x / sum, 9.0 * y / sum};
}

Vec3 VecOf(const Rgb& rgb) { return {rgb.r, rgb.g, rgb.b}; }

// From a point to the nearest of a straight way.
double ApartFromWay(const Place& at, const Place& from, const Place& to) {
  const double du = to.u - from.u, dv = to.v - from.v;
  const double length2 = du * du + dv * dv;
  const double along =
      length2 > 0.0 ? std::clamp(((at.u - from.u) * du + (at.v - from.v) * dv) / length2, 0.0, 1.0)
                    : 0.0;
  return Apart(at, {from.u + along * du, from.v + along * dv});
}

// What its CCT and Duv leave open.
double U95Of(const FittedColor& color) {
  double u95 = 0.0;
  const double duv = color.duv ? color.duv->value : 0.0;
  if (color.cct_K && LowEnd(*color.cct_K) > 0.0) {
    const auto at = [&](double kelvin) { return PlaceOfXy(XyFromCct(Kelvin(kelvin), duv)); };
    const Place middle = at(color.cct_K->value);
    u95 =
        std::max(Apart(at(LowEnd(*color.cct_K)), middle), Apart(at(HighEnd(*color.cct_K)), middle));
  }
  constexpr double kUv1976PerDuv = 1.5;  // v' = 1.5 v
  return std::hypot(u95, color.duv ? kUv1976PerDuv * color.duv->u95 : 0.0);
}

}  // namespace

std::vector<ComparedColor> CompareColors(const LightFile& lamps,
                                         const std::vector<EngineLight>& lights,
                                         std::optional<Xy> white) {
  std::vector<ComparedColor> rows;
  for (const FittedLight& lamp : lamps.lights) {
    Warnings said_by_export;
    const EmittedColor color = ColorOfLight(lamp, {RgbSpace::kSrgb, white}, said_by_export);
    const auto own = PlaceOfRgb(VecOf(color.unit_luminance));
    const auto clipped = PlaceOfRgb(VecOf(color.max_normalised));
    if (!color.xy || !own || !clipped) continue;
    for (const EngineLight& light : lights) {
      const bool stands_for =
          light.name.empty() ? light.kind == EngineLightKind::kDome && lamp.kind == LightKind::kDome
                             : light.name == lamp.name;
      const auto at = light.rgb ? PlaceOfRgb(*light.rgb) : std::nullopt;
      if (!stands_for || !at) continue;
      rows.push_back({lamp.name, *color.xy, ApartFromWay(*at, *own, *clipped),
                      U95Of(lamp.color) + kRounding_uv});
    }
  }
  return rows;
}

}  // namespace lightcal
