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
  Xyz color = XyzFromXyAtUnitY(xy);
  if (target.white) {
    color = AdaptBradford(color, *target.white, PrimariesOf(target.space).white);
    color = {color.X / color.Y, 1.0, color.Z / color.Y};
  }
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

void WarnOfClipping(const std::string& light, const Rgb& color, RgbSpace space,
                    Warnings& warnings) {
  const std::array<std::pair<const char*, double>, 3> components = {
      {{"red", color.r}, {"green", color.g}, {"blue", color.b}}};
  std::string clipped;
  for (const auto& [name, value] : components) {
    if (value >= 0.0) continue;
    clipped += (clipped.empty() ? "" : ", ") + std::string(name) + " " + RoundedText(value, 2);
  }
  if (clipped.empty()) return;
  warnings.push_back({"out_of_gamut", light,
                      "the colour lies outside " + SpaceTitle(space) + " (linear " + clipped +
                          " at Y = 1), clipped to 0: slightly too pale, luminance kept"});
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
  WarnOfClipping(light.name, color.unit_luminance, target.space, warnings);
  return color;
}

}  // namespace lightcal
