// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/punctual_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/core/numbers_text.h"
#include "lightcal/light/axial_shape.h"
#include "lightcal/photometry/inverse_square.h"
#include "lightcal/photometry/lambert.h"
#include "lightcal/presets/table_cone.h"
#include "lightcal/records/light_curve.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal {
namespace {

// An engine divides by (cos inner - cos outer): equal angles become this much of the outer one.
constexpr double kHardEdgeInnerShare = 1.0 - 1e-6;

bool IsDirected(LightKind kind) {
  return kind == LightKind::kSpot || kind == LightKind::kDisk || kind == LightKind::kRect ||
         kind == LightKind::kPhotometric;
}

Vec3 UnitOr(const std::optional<Vec3>& v, const Vec3& fallback) {
  if (!v) return fallback;
  const double length = Length(*v);
  return length > 0.0 && std::isfinite(length) ? *v * (1.0 / length) : fallback;
}

// ---- what kind of engine light, and what is lost ----

}  // namespace

bool IsSpotWithoutCone(const FittedLight& lamp) {
  return lamp.kind == LightKind::kSpot && !lamp.distribution &&
         !(lamp.outer_deg.value_or(0.0) > 0.0);
}

namespace {

void BecomeSpot(PunctualLight& light, double inner_rad, double outer_rad) {
  light.type = PunctualType::kSpot;
  const double outer = std::min(outer_rad, std::numbers::pi / 2.0);
  light.cone = {Radians(std::clamp(inner_rad, 0.0, outer * kHardEdgeInnerShare)), Radians(outer)};
}

void FromCone(const FittedLight& lamp, PunctualLight& light, Warnings& warnings) {
  if (!lamp.outer_deg || !(*lamp.outer_deg > 0.0)) {
    light.type = PunctualType::kPoint;
    if (IsSpotWithoutCone(lamp)) {
      warnings.push_back({"cone_unknown", lamp.name,
                          "the spot has no outer_deg: exported as a point of its axial intensity; "
                          "give beam_deg or outer_deg, or measure off the axis"});
      light.substitution =
          "a spot of unknown cone exported as a point of its axial intensity: right on the axis "
          "only";
    }
    return;
  }
  if (*lamp.outer_deg > 90.0) {
    warnings.push_back({"cone_clipped", lamp.name,
                        "outer_deg above 90 is not possible in engines; exported as 90"});
  }
  BecomeSpot(light, RadiansFromDegrees(lamp.inner_deg.value_or(0.0)).value(),
             RadiansFromDegrees(*lamp.outer_deg).value());
}

std::string PerCent(double part) { return RoundedText(100.0 * part, 2) + " %"; }

void FromDistribution(const FittedLight& lamp, PunctualLight& light, Warnings& warnings) {
  if (!lamp.distribution) {
    FromCone(lamp, light, warnings);
    light.substitution = std::string("a measured distribution exported as a ") +
                         (light.type == PunctualType::kSpot ? "spot" : "point") +
                         ": right on the axis only";
    return;
  }
  const auto nearest = SubstituteForTable(lamp.distribution->table);
  if (!nearest) {
    light.substitution =
        "a measured distribution that is dark along its aim, exported as a point of its mean "
        "intensity: its flux is kept, no direction is right";
    return;
  }
  if (nearest->cone) BecomeSpot(light, nearest->cone->inner.value(), nearest->cone->outer.value());
  const double flux = nearest->flux - 1.0;
  light.strays = nearest->worst;
  light.substitution =
      DistributionWords(lamp) + " exported as the nearest " + (nearest->cone ? "spot" : "point") +
      ", round about its aim: right on the axis, elsewhere within " + PerCent(nearest->worst) +
      " of the axial intensity, flux " + PerCent(std::abs(flux)) + (flux < 0.0 ? " low" : " high");
}

// ", 21 % at 1 m, where it was read": what a point of a tube's intensity gives too much at the
// nearest reading; "" where it is little.
std::string TooMuchWhereRead(const FittedLight& lamp) {
  constexpr double kLeastTold = 0.02;
  if (!lamp.length_m) return "";
  const AxialShape shape{AxialShape::Outline::kTube, 0.5 * *lamp.length_m};
  const auto nearest = NearestRead_m(lamp);
  if (!nearest) return "";
  const double too_much = 1.0 / AxialShapeFactor(shape, *nearest) - 1.0;
  if (!(too_much > kLeastTold)) return "";
  return ", " + PerCent(too_much) + " at " + RoundedText(*nearest, 3) + " m, where it was read";
}

void ChooseType(const FittedLight& lamp, PunctualLight& light, Warnings& warnings) {
  switch (lamp.kind) {
    case LightKind::kPoint:
      break;
    case LightKind::kSpot:
      if (lamp.distribution) {
        FromDistribution(lamp, light, warnings);
      } else {
        FromCone(lamp, light, warnings);
      }
      break;
    case LightKind::kDirectional:
      light.type = PunctualType::kDirectional;
      break;
    case LightKind::kSphere:
      light.substitution =
          "a sphere exported as a point: illuminance is the same everywhere outside it, shadows "
          "are "
          "hard";
      break;
    case LightKind::kTube:
      light.substitution =
          "a tube exported as a point: right broadside from 5 lengths on alone, too bright nearer" +
          TooMuchWhereRead(lamp) + ", and towards its ends; flux 27 % high";
      break;
    case LightKind::kDisk:
    case LightKind::kRect:
      BecomeSpot(light, std::acos(kLambertianInnerCosine), std::numbers::pi / 2.0);
      light.substitution =
          "a flat source exported as a 90-degree spot: right on the axis beyond 5 times its size, "
          "off the axis within 17 % of the axial intensity, flux 10 % low, shadows are hard";
      light.strays = 1.0 - kLambertianInnerCosine;
      break;
    case LightKind::kPhotometric:
      FromDistribution(lamp, light, warnings);
      break;
    case LightKind::kDome:
      light.type = PunctualType::kDirectional;
      light.substitution =
          "a dome exported as a directional light from above: right on upward surfaces only, "
          "shadows "
          "are hard";
      break;
  }
  if (!light.substitution.empty() && !IsSpotWithoutCone(lamp)) {  // told as cone_unknown
    warnings.push_back({"substituted", lamp.name, light.substitution, light.strays});
  }
}

// ---- how bright ----

Result<Uncertain> IlluminanceOf(const FittedLight& lamp) {
  if (lamp.illuminance_lx) return *lamp.illuminance_lx;
  if (lamp.kind == LightKind::kDome && lamp.luminance_nits) {
    return Uncertain{LuxUnderUniformDome(Nits(lamp.luminance_nits->value)).value(),
                     LuxUnderUniformDome(Nits(lamp.luminance_nits->u95)).value(), std::nullopt,
                     std::nullopt};
  }
  return Refused("no_illuminance", lamp.name,
                 "a " + std::string(LightKindName(lamp.kind)) +
                     " light is exported by its illuminance, which was not measured");
}

Result<Uncertain> PhotometricValue(const FittedLight& lamp, PunctualType type) {
  auto value = type == PunctualType::kDirectional ? IlluminanceOf(lamp)
               : lamp.intensity_cd
                   ? Result<Uncertain>(*lamp.intensity_cd)
                   : Refused("no_intensity", lamp.name,
                             "has no luminous intensity to export; measure its illuminance at a "
                             "known distance");
  if (value && !(std::isfinite(value->value) && std::isfinite(value->u95))) {
    return Failed("not_finite", lamp.name, "its intensity is not a finite number");
  }
  if (value && !(value->value > 0.0)) {
    return Refused("no_intensity", lamp.name, "its intensity is not above zero");
  }
  return value;
}

// A measured table may peak off its aim, along which points and spots shine; where it is dark
// there, its mean over the sphere stands for it.
Uncertain AlongAim(const FittedLight& lamp, const Uncertain& peak) {
  if (!lamp.distribution) return peak;
  const IntensityTable& table = lamp.distribution->table;
  const double highest = table.peak().intensity.value();
  const double along = table.At(Radians(0.0), Radians(0.0)).value() / highest;
  const double mean = table.Flux().value() / (4.0 * std::numbers::pi * highest);
  const double part = along > 0.0 ? along : mean;
  return {peak.value * part, peak.u95 * part, std::nullopt, std::nullopt};
}

void SetIntensity(PunctualLight& light, const Uncertain& value) {
  light.photometric = value.value;
  light.intensity = value.value / light.color.luminance;
  if (!(value.u95 > 0.0)) return;
  light.photometric_u95 = value.u95;
  light.intensity_u95 = light.intensity * std::hypot(value.u95 / value.value,
                                                     light.color.luminance_u95.value_or(0.0));
}

// ---- where ----

void Place(const FittedLight& lamp, PunctualLight& light) {
  constexpr Vec3 kDown = {0.0, 0.0, -1.0};
  light.position_m = lamp.position_m.value_or(Vec3{});
  light.aim = lamp.kind == LightKind::kDome ? kDown : UnitOr(lamp.aim, kDown);
  if (light.type == PunctualType::kDirectional || !lamp.distance_offset_m) return;
  if (lamp.aim || IsDirected(lamp.kind)) {
    light.position_m = light.position_m - light.aim * lamp.distance_offset_m->value;
  }
}

Result<PunctualLight> PunctualLightFrom(const FittedLight& lamp, const ColorTarget& color,
                                        Warnings& warnings) {
  PunctualLight light;
  light.name = lamp.name;
  light.kind = lamp.kind;
  ChooseType(lamp, light, warnings);
  const auto value = PhotometricValue(lamp, light.type);
  if (!value) return tl::unexpected(value.error());
  light.color = ColorOfLight(lamp, color, warnings);
  SetIntensity(light, AlongAim(lamp, *value));
  Place(lamp, light);
  return light;
}

void WarnOfStackedLights(const LightFile& file, Warnings& warnings) {
  constexpr int kNamed = 8;
  std::string names;
  int count = 0;
  for (const FittedLight& lamp : file.lights) {
    if (lamp.position_m || lamp.kind == LightKind::kDirectional || lamp.kind == LightKind::kDome) {
      continue;
    }
    ++count;
    if (count <= kNamed) names += (names.empty() ? "" : ", ") + lamp.name;
  }
  if (count < 2) return;
  if (count > kNamed) names += " and " + std::to_string(count - kNamed) + " more";
  warnings.push_back({"position_unknown", names,
                      "no position_m was given: all stand at the origin and add up there; give "
                      "positions, or show one light at a time"});
}

}  // namespace

Result<std::vector<PunctualLight>> PunctualLightsFrom(const LightFile& file, Warnings& warnings,
                                                      const ColorTarget& color) {
  if (file.lights.empty()) return Refused("no_lights", "", "there is no light to export");
  std::vector<PunctualLight> lights;
  for (const FittedLight& lamp : file.lights) {
    auto light = PunctualLightFrom(lamp, color, warnings);
    if (!light) return Propagate(std::move(light));
    lights.push_back(std::move(*light));
  }
  WarnOfStackedLights(file, warnings);
  return lights;
}

std::optional<double> NearestRead_m(const FittedLight& lamp) {
  std::optional<double> nearest;
  for (const ResidualRow& row : lamp.residuals) {
    if (row.used && row.distance_m && *row.distance_m > 0.0) {
      nearest = std::min(nearest.value_or(*row.distance_m), *row.distance_m);
    }
  }
  return nearest;
}

double EffectiveOffset_m(const FittedLight& lamp) {
  if (lamp.kind == LightKind::kDirectional || lamp.kind == LightKind::kDome) return 0.0;
  return (lamp.distance_offset_m ? lamp.distance_offset_m->value : 0.0) + SurfaceRadius_m(lamp);
}

Lux IlluminanceAt(const PunctualLight& light, const Vec3& point, const Vec3& normal) {
  if (light.type == PunctualType::kDirectional) {
    return Lux(light.photometric * std::max(0.0, -Dot(light.aim, normal)));
  }
  const Vec3 to_point = point - light.position_m;
  const double distance = Length(to_point);
  if (!(distance > 0.0)) return Lux(0.0);
  const double attenuation = light.type == PunctualType::kSpot
                                 ? SpotAttenuation(AngleFromAim(light.aim, to_point), light.cone,
                                                   SpotFalloff::kSquaredLinear)
                                 : 1.0;
  return LuxFromCandela(Candela(light.photometric * attenuation),
                        {.distance = Metres(distance),
                         .offset = Metres(0.0),
                         .cos_incidence = -Dot(to_point, normal) / distance});
}

}  // namespace lightcal
