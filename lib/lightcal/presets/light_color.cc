// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/light_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

std::optional<Xy> ChromaticityOf(const FittedColor& color) {
  if (color.xy) return color.xy;
  if (color.cct_K && color.cct_K->value > 0.0) {
    return XyFromCct(Kelvin(color.cct_K->value), color.duv ? color.duv->value : 0.0);
  }
  return std::nullopt;
}

bool HasColor(const std::optional<Xy>& xy) {
  return xy && std::isfinite(xy->x) && std::isfinite(xy->y) && xy->y > 0.0;
}

Rgb LinearAtUnitLuminance(Xy xy, const ColorTarget& target) {
  Xyz color = AdaptedToSpace(XyzFromXyAtUnitY(xy), target.SceneWhite(), target.space);
  color = {color.X / color.Y, 1.0, color.Z / color.Y};
  return LinearRgbFromXyz(color, target.space);
}

// Y = 1 leaves at least one component positive, so the division is defined.
Rgb MaxNormalised(const Rgb& c) {
  const double largest = std::max({c.r, c.g, c.b});
  return {std::max(c.r, 0.0) / largest, std::max(c.g, 0.0) / largest, std::max(c.b, 0.0) / largest};
}

double LuminanceOfMaxNormalised(Xy xy, const ColorTarget& target) {
  return LuminanceOfRgb(MaxNormalised(LinearAtUnitLuminance(xy, target)), target.space);
}

std::optional<double> LuminanceU95(const FittedColor& color, const ColorTarget& target) {
  if (!color.cct_K || !(color.cct_K->u95 > 0.0)) return std::nullopt;
  const double t = color.cct_K->value;
  const double u = std::min(color.cct_K->u95, t / 2.0);
  const double duv = color.duv ? color.duv->value : 0.0;
  const double warm = LuminanceOfMaxNormalised(XyFromCct(Kelvin(t - u), duv), target);
  const double cool = LuminanceOfMaxNormalised(XyFromCct(Kelvin(t + u), duv), target);
  return std::abs(std::log(cool / warm)) / 2.0;
}

std::string SpaceTitle(RgbSpace space) {
  switch (space) {
    case RgbSpace::kSrgb:
      return "Rec. 709";
    case RgbSpace::kRec2020:
      return "Rec. 2020";
    case RgbSpace::kAcescg:
      return "ACEScg";
    case RgbSpace::kDisplayP3:
      return "Display P3";
  }
  return {};
}

// The first of the wider spaces that holds it; "" = none does.
std::string_view SpaceThatHolds(Xy xy, const std::optional<Xy>& white) {
  for (const RgbSpace space : {RgbSpace::kRec2020, RgbSpace::kAcescg}) {
    const Rgb c = LinearAtUnitLuminance(xy, {space, white});
    if (std::min({c.r, c.g, c.b}) >= 0.0) return RgbSpaceWord(space);
  }
  return {};
}

// How far apart two colours of one space look, on CIE's uniform scale of 1976: 0.0011 is a just
// noticeable step.
double DeltaUv(const Rgb& a, const Rgb& b, RgbSpace space) {
  const Uv1976 p = Uv1976FromXy(XyFromXyz(XyzFromLinearRgb(a, space)));
  const Uv1976 q = Uv1976FromXy(XyFromXyz(XyzFromLinearRgb(b, space)));
  return std::hypot(p.u - q.u, p.v - q.v);
}

void WarnOfClipping(const std::string& light, Xy xy, const EmittedColor& emitted,
                    Warnings& warnings) {
  const Rgb& color = emitted.unit_luminance;
  const RgbSpace space = emitted.target.space;
  const std::array<std::pair<const char*, double>, 3> components = {
      {{"red", color.r}, {"green", color.g}, {"blue", color.b}}};
  std::string clipped;
  for (const auto& [name, value] : components) {
    if (value >= 0.0) continue;
    clipped += (clipped.empty() ? "" : ", ") + std::string(name) + " " + RoundedText(value, 2);
  }
  if (clipped.empty()) return;
  const std::string_view wider = SpaceThatHolds(xy, emitted.target.white);
  const bool holds = !wider.empty() && wider != RgbSpaceWord(space);
  warnings.push_back({"out_of_gamut", light,
                      "the colour lies outside " + SpaceTitle(space) + " (linear " + clipped +
                          " at Y = 1), clipped to 0: too pale by " +
                          RoundedText(DeltaUv(color, emitted.max_normalised, space), 2) +
                          " in u'v', luminance kept" +
                          (holds ? "; {color.space} " + std::string(wider) +
                                       " holds it, in engines that can work in it"
                                 : "")});
}

}  // namespace

std::string_view RgbSpaceWord(RgbSpace space) {
  switch (space) {
    case RgbSpace::kSrgb:
      return "rec709";
    case RgbSpace::kRec2020:
      return "rec2020";
    case RgbSpace::kAcescg:
      return "acescg";
    case RgbSpace::kDisplayP3:
      return "p3";
  }
  return {};
}

EmittedColor ColorOfLight(const FittedLight& light, const ColorTarget& target, Warnings& warnings) {
  EmittedColor color;
  color.target = target;
  const std::optional<Xy> xy = ChromaticityOf(light.color);
  if (!HasColor(xy)) {
    warnings.push_back({"color_unknown", light.name,
                        "no colour was measured: exported white; read the CCT or a spectrum"});
    return color;
  }
  color.xy = xy;
  color.unit_luminance = LinearAtUnitLuminance(*xy, target);
  color.max_normalised = MaxNormalised(color.unit_luminance);
  color.luminance = LuminanceOfRgb(color.max_normalised, target.space);
  color.luminance_u95 = LuminanceU95(light.color, target);
  WarnOfClipping(light.name, *xy, color, warnings);
  return color;
}

}  // namespace lightcal
