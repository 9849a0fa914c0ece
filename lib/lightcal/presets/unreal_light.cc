// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/unreal_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

constexpr double kCentimetres = 100.0;
constexpr double kWidestOuter_deg = 88.9;  // the engine clamps here

// Without the -0 that atan2 gives.
double Degrees(double radians) {
  const double degrees = DegreesFromRadians(Radians(radians));
  return degrees == 0.0 ? 0.0 : degrees;
}

// The CCT of a source the engine's own black body renders, to within a Duv of .001.
std::optional<double> PlanckianTemperature(const PresetLight& light) {
  constexpr double kNearDuv = 0.001;
  const EmittedColor& color = light.color();
  if (!color.xy || color.target.white || color.target.space != RgbSpace::kSrgb) return std::nullopt;
  const CctResult found = CctFromXy(*color.xy);
  if (!found.valid() || std::abs(found.duv) > kNearDuv) return std::nullopt;
  const double t = found.temperature.value();
  return t >= 1000.0 && t <= 15000.0 ? std::optional(t) : std::nullopt;
}

// Sets LightColor; the luminance of the colour those bytes hold.
double BakeColor(const EmittedColor& color, UnrealLight& out) {
  const Rgb& m = color.max_normalised;
  const std::array<double, 3> linear = {m.r, m.g, m.b};
  std::array<double, 3> held{};
  for (std::size_t i = 0; i < 3; ++i) {
    out.color_srgb8[i] = static_cast<int>(std::lround(255.0 * SrgbEncoded(linear[i])));
    held[i] = SrgbDecoded(out.color_srgb8[i] / 255.0);
  }
  return LuminanceOfRgb({held[0], held[1], held[2]}, color.target.space);
}

void PutUnrealCone(const PresetLight& light, DerivedLight& out, Warnings& warnings) {
  const auto [inner, outer] = UnrealSpotOf(light);
  out.Put("inner_cone_angle", inner);
  out.Put("outer_cone_angle", outer);
  if (DegreesFromRadians(light.cone.cone.outer) <= kWidestOuter_deg || !light.beam) return;
  const SpotCone written = {RadiansFromDegrees(inner), RadiansFromDegrees(outer)};
  const std::string error = ConeErrorText(JudgeCone(EngineConeLaw::kSquared, written, *light.beam));
  warnings.push_back({"cone_clipped", light.name(),
                      "Unreal's cones end at 88.9 degrees: exported with that, " +
                          (error.empty() ? "within 0.1 % of the axial intensity" : error)});
}

}  // namespace

std::array<double, 2> UnrealAnglesOf(const SpotCone& cone) {
  return {std::min(DegreesFromRadians(cone.inner), kWidestOuter_deg),
          std::min(DegreesFromRadians(cone.outer), kWidestOuter_deg)};
}

std::array<double, 2> UnrealSpotOf(const PresetLight& light) {
  const bool refitted = light.form == LightForm::kSpot;
  if (!refitted && light.form != LightForm::kRect) return {kWidestOuter_deg, kWidestOuter_deg};
  return UnrealAnglesOf(refitted ? light.cone.cone : light.punctual.cone);
}

UnrealLight UnrealLightFrom(const PresetLight& light, const FalloffRefit& refit,
                            Warnings& warnings) {
  UnrealLight out;
  DerivedLight& derived = out.derived;
  derived.substitution = light.substitution;
  if (light.form == LightForm::kDome) {  // of the picture's texels, which are cd/m2
    derived.type = "SkyLight";
    derived.Put("intensity", 1.0);
    derived.Put("upward_lx", light.lux);
    return out;
  }
  double luminance = 1.0;
  if (const auto kelvin = PlanckianTemperature(light)) {
    out.use_temperature = true;
    derived.Put("temperature", *kelvin);
  } else {
    luminance = BakeColor(light.color(), out);
    derived.Put("light_color",
                {static_cast<double>(out.color_srgb8[0]), static_cast<double>(out.color_srgb8[1]),
                 static_cast<double>(out.color_srgb8[2])});
  }
  if (light.form == LightForm::kDirectional) {
    derived.type = "DirectionalLight";
    derived.Put("intensity", light.lux / luminance);
    derived.Put("light_source_angle", light.angular_diameter_deg.value_or(0.0));
    return out;
  }
  derived.Put("intensity", light.candela * refit.intensity_factor / luminance);
  derived.Put("attenuation_radius", refit.range.value() * kCentimetres);
  if (light.form == LightForm::kRect) {
    derived.type = "RectLight";
    derived.Put("source_width", light.width_m * kCentimetres);
    derived.Put("source_height", light.height_m * kCentimetres);
    derived.Put("barn_door_length", 0.0);
    return out;
  }
  derived.type = light.form == LightForm::kSpot ? "SpotLight" : "PointLight";
  derived.Put("source_radius", light.radius_m * kCentimetres);
  if (light.form == LightForm::kSpot) PutUnrealCone(light, derived, warnings);
  if (light.form != LightForm::kTable) return out;
  derived.elsewhere.push_back({"ies", {1.0}});
  if (light.punctual.type == PunctualType::kSpot) {
    const auto [inner, outer] = UnrealAnglesOf(light.punctual.cone);
    derived.elsewhere.push_back({"spot_angles_deg", {inner, outer}});
  }
  return out;
}

Emission EmittedInUnreal(const DerivedLight& light, LightKind /*kind*/, double axial_part) {
  double emitted = NumberIn(light, "intensity");
  if (light.type == "SkyLight") return {.lux = emitted * NumberIn(light, "upward_lx")};
  if (const DerivedField* color = light.Find("light_color")) {
    const std::vector<double>& c = color->values;
    emitted *= Rec709Luminance(
        Vec3{SrgbDecoded(c[0] / 255.0), SrgbDecoded(c[1] / 255.0), SrgbDecoded(c[2] / 255.0)});
  }
  if (light.type == "DirectionalLight") return {.lux = emitted};
  Emission out{.candela = emitted * axial_part,
               .falloff = kUnrealFalloff,
               .range_m = NumberIn(light, "attenuation_radius") / kCentimetres};
  out.table = light.Find("ies") != nullptr;
  if (light.type == "SpotLight") {
    out.cone =
        ConeOfLaw{.inner_rad = RadiansFromDegrees(NumberIn(light, "inner_cone_angle")).value(),
                  .outer_rad = RadiansFromDegrees(NumberIn(light, "outer_cone_angle")).value()};
  }
  if (light.type == "RectLight") {
    out.shape = {AxialShape::Outline::kRect, 0.5 * NumberIn(light, "source_width") / kCentimetres,
                 0.5 * NumberIn(light, "source_height") / kCentimetres};
  }
  return out;
}

UnrealRotator UnrealRotatorFromAxes(const Vec3& forward, const Vec3& right, const Vec3& up) {
  constexpr double kVertical = 1e-9;
  const double level = std::hypot(forward[0], forward[1]);
  UnrealRotator out;
  out.pitch_deg = Degrees(std::atan2(forward[2], level));
  if (level > kVertical) {
    out.yaw_deg = Degrees(std::atan2(forward[1], forward[0]));
    out.roll_deg = Degrees(std::atan2(-right[2], up[2]));
  } else {
    // right = (sin r sin p, cos r, 0)
    out.roll_deg = Degrees(std::atan2(forward[2] > 0.0 ? right[0] : -right[0], right[1]));
  }
  return out;
}

}  // namespace lightcal
