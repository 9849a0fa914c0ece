// SPDX-License-Identifier: Apache-2.0
#include "report/parity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/light/axial_shape.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/godot_temperature.h"
#include "lightcal/presets/rig.h"
#include "lightcal/report/light_curve.h"
#include "srgb.h"

namespace lightcal::app {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCentimetre = 0.01;

// Where the lamp is compared.
struct Place {
  double distance_m = 0.0;    // from the reference point; 0 at infinity
  double separation_m = 1.0;  // from the effective source
  double lux = 0.0;           // of the lamp alone
  double axial_part = 1.0;    // intensity on the axis over that of the peak
};

std::optional<Place> PlaceOf(const FittedLight& lamp) {
  if (lamp.kind == LightKind::kDirectional || lamp.kind == LightKind::kDome) {
    if (!lamp.illuminance_lx || !(lamp.illuminance_lx->value > 0.0)) return std::nullopt;
    return Place{.distance_m = 0.0,
                 .separation_m = 1.0,
                 .lux = lamp.illuminance_lx->value,
                 .axial_part = 1.0};
  }
  LightFile alone;
  alone.lights = {lamp};
  Warnings said_by_export;
  const auto punctual = PunctualLightsFrom(alone, said_by_export);
  const auto curve = report::LightCurve::Of(lamp);
  if (!punctual || !curve) return std::nullopt;
  const Rig rig = BuildRig(alone, *punctual);
  Place place{.distance_m = rig.distance.value(),
              .separation_m = rig.separation.value(),
              .lux = 0.0,
              .axial_part = 1.0};
  if (lamp.distribution) {
    const IntensityTable& table = lamp.distribution->table;
    place.axial_part = table.Towards({0.0, 0.0, -1.0}) / table.peak().intensity;
  }
  const double ambient = lamp.ambient_lx ? lamp.ambient_lx->value : 0.0;
  place.lux = place.axial_part * (curve->LuxAt(place.distance_m) - ambient);
  return place.lux > 0.0 ? std::optional(place) : std::nullopt;
}

// ---- what a file's numbers mean ----

// Luminance of an sRGB-encoded colour whose white is `white`.
double DecodedLuma(const DerivedField& color, double white) {
  const std::vector<double>& c = color.values;
  return Rec709Luminance(
      Vec3{SrgbDecoded(c[0] / white), SrgbDecoded(c[1] / white), SrgbDecoded(c[2] / white)});
}

// The same multiplied by what Godot makes of the light's temperature.
double LumaUnder(double kelvin, const DerivedField& color) {
  const Rgb tint = GodotTemperatureColor(kelvin);
  const std::vector<double>& c = color.values;
  return Rec709Luminance(
      Vec3{SrgbDecoded(c[0]) * tint.r, SrgbDecoded(c[1]) * tint.g, SrgbDecoded(c[2]) * tint.b});
}

// A light as its engine has it: cd on the axis, or lux of one at infinity.
struct Emission {
  std::optional<double> candela, lux;
  AxialShape shape{};
  std::optional<EngineFalloff> window{};
  double range_m = 0.0;
};

double Value(const DerivedLight& light, std::string_view name) {
  const DerivedField* field = light.Find(name);
  return field == nullptr ? 0.0 : field->values.front();
}

// Its area seen along the axis, from the fields it has.
double SeenArea(const DerivedLight& light) {
  const double radius = Value(light, "radius");
  if (light.Find("width") != nullptr) return Value(light, "width") * Value(light, "height");
  if (light.Find("length") != nullptr) return 2.0 * radius * Value(light, "length");
  return kPi * radius * radius;
}

AxialShape ShapeOf(const DerivedLight& light, LightKind kind) {
  using Outline = AxialShape::Outline;
  if (light.Find("width") != nullptr) {
    return {Outline::kRect, 0.5 * Value(light, "width"), 0.5 * Value(light, "height")};
  }
  if (light.Find("length") != nullptr) return {Outline::kTube, 0.5 * Value(light, "length"), 0.0};
  return kind == LightKind::kDisk ? AxialShape{Outline::kDisk, Value(light, "radius"), 0.0}
                                  : AxialShape{};
}

Emission OfUnreal(const DerivedLight& light, const Place& place) {
  const DerivedField* color = light.Find("light_color");
  const double emitted =
      Value(light, "intensity") * (color == nullptr ? 1.0 : DecodedLuma(*color, 255.0));
  Emission out;
  if (light.type == "DirectionalLight") {
    out.lux = emitted;
    return out;
  }
  out.candela = emitted * place.axial_part;
  out.window = EngineFalloff::kUnreal;
  out.range_m = kCentimetre * Value(light, "attenuation_radius");
  if (light.type == "RectLight") {
    out.shape = {AxialShape::Outline::kRect, 0.5 * kCentimetre * Value(light, "source_width"),
                 0.5 * kCentimetre * Value(light, "source_height")};
  }
  return out;
}

Emission OfUnity(const DerivedLight& light) {
  const double emitted = Value(light, "intensity") * Rec709Luminance(light.Find("color")->values);
  Emission out;
  if (light.type == "Directional") {
    out.lux = emitted;
    return out;
  }
  out.candela = emitted;
  out.window = EngineFalloff::kUnityHdrp;
  out.range_m = Value(light, "range_m");
  if (light.type == "Rectangle") {
    const double width = Value(light, "area_width_m");
    const double height = Value(light, "area_height_m");
    out.candela = emitted * width * height;
    out.shape = {AxialShape::Outline::kRect, 0.5 * width, 0.5 * height};
  }
  return out;
}

Emission OfGodot(const DerivedLight& light) {
  Emission out;
  if (light.type == "Environment") {
    out.lux = kPi * Value(light, "background_intensity") *
              DecodedLuma(*light.Find("background_color"), 1.0);
    return out;
  }
  const double luminance = LumaUnder(Value(light, "light_temperature"), *light.Find("light_color"));
  if (light.type == "DirectionalLight3D") {
    out.lux = Value(light, "light_intensity_lux") * luminance;
    return out;
  }
  const bool spot = light.type == "SpotLight3D";
  out.candela = Value(light, "light_intensity_lumens") * luminance / (spot ? kPi : 4.0 * kPi);
  out.window = EngineFalloff::kGodot;
  out.range_m = Value(light, spot ? "spot_range" : "omni_range");
  return out;
}

Emission OfUsd(const DerivedLight& light, const FittedLight& lamp, const Place& place) {
  const double emitted = Value(light, "intensity") * Rec709Luminance(light.Find("color")->values);
  Emission out;
  if (light.type == "DistantLight") {
    out.lux = emitted;
  } else if (light.type == "DomeLight") {
    out.lux = kPi * emitted;
  } else {
    out.candela = emitted * SeenArea(light);
    // A profile multiplies a light of 1 cd.
    if (lamp.distribution) out.candela = *out.candela * place.axial_part * lamp.intensity_cd->value;
    out.shape = ShapeOf(light, lamp.kind);
  }
  return out;
}

// Mitsuba and pbrt: rgb of what is emitted, at full scale.
Emission OfPathTracer(const DerivedLight& light, LightKind kind, double emitted) {
  Emission out;
  if (light.type == "directional" || light.type == "distant") {
    out.lux = emitted;
  } else if (light.type == "constant" || light.type == "infinite") {
    out.lux = kPi * emitted;
  } else if (light.type == "area" || light.type == "diffuse") {
    out.candela = emitted * SeenArea(light);
    out.shape = ShapeOf(light, kind);
  } else {
    out.candela = emitted;
  }
  return out;
}

double MitsubaEmits(const DerivedLight& light) {
  for (const char* name : {"intensity", "irradiance", "radiance"}) {
    if (const DerivedField* field = light.Find(name)) {
      return Rec709Luminance(field->values) / Value(light, "pre_exposure");
    }
  }
  return 0.0;
}

double PbrtEmits(const DerivedLight& light) {
  const double scale =
      light.Find("scale") != nullptr ? Value(light, "scale") : Value(light, "illuminance");
  return scale * Rec709Luminance(light.Find("rgb")->values);
}

Emission EmissionOf(std::string_view target, const DerivedLight& light, const FittedLight& lamp,
                    const Place& place) {
  if (target == "unreal") return OfUnreal(light, place);
  if (target == "unity") return OfUnity(light);
  if (target == "godot") return OfGodot(light);
  if (target == "usd") return OfUsd(light, lamp, place);
  if (target == "mitsuba") return OfPathTracer(light, lamp.kind, MitsubaEmits(light));
  if (target == "pbrt") return OfPathTracer(light, lamp.kind, PbrtEmits(light));
  return {};
}

// ---- lux and its law, in words ----

struct Lit {
  double lux = 0.0;
  std::string law;
};

std::string InverseSquare(double range_m) {
  if (!(range_m > 0.0)) return "1/d²";
  return "1/d², range " + RoundedText(range_m, 3) + " m";
}

std::optional<Lit> LitBy(const Emission& emission, const Place& place) {
  if (emission.lux) return Lit{*emission.lux, "no falloff"};
  if (!emission.candela) return std::nullopt;
  const double d = place.separation_m;
  const double shape = AxialShapeFactor(emission.shape, d);
  const bool flat = emission.shape.outline != AxialShape::Outline::kPoint;
  const double per_candela = emission.window
                                 ? FalloffOf(*emission.window, Metres(d), Metres(emission.range_m))
                                 : 1.0 / (d * d);
  return Lit{*emission.candela * shape * per_candela,
             (flat ? "area light, " : "") + InverseSquare(emission.range_m)};
}

// The light of a file that `check` reads, seen from the place on its own axis.
std::optional<Lit> LitBy(const EngineLight& light, const Place& place) {
  const Vec3 point = light.position_m + light.aim * place.separation_m;
  const double lux = LuxAt(light, point, light.aim * -1.0);
  switch (light.kind) {
    case EngineLightKind::kSun:
    case EngineLightKind::kDome:
      return Lit{lux, "no falloff"};
    case EngineLightKind::kFlat:
      return Lit{lux, "area light, 1/d²"};
    case EngineLightKind::kTable:
      return Lit{lux, "measured distribution, 1/d²"};
    default:
      return Lit{lux, InverseSquare(light.range_m)};
  }
}

std::optional<Lit> LitIn(const EngineExport& exported, std::size_t index, const FittedLight& lamp,
                         const Place& place) {
  const auto read = std::ranges::find(exported.read_back, lamp.name, &EngineLight::name);
  if (read != exported.read_back.end()) return LitBy(*read, place);
  const DerivedLight& derived = exported.derived[index];
  return LitBy(EmissionOf(exported.engine->target, derived, lamp, place), place);
}

}  // namespace

std::vector<ParityRow> ParityOf(const LightFile& lights, const std::vector<EngineExport>& exports) {
  std::vector<ParityRow> rows;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    const auto place = PlaceOf(lamp);
    if (!place) continue;
    for (const EngineExport& exported : exports) {
      const auto lit = LitIn(exported, i, lamp, *place);
      if (!lit || !std::isfinite(lit->lux)) continue;
      rows.push_back({.light = lamp.name,
                      .engine = std::string(exported.engine->title),
                      .distance_m = place->distance_m,
                      .expected_lx = place->lux,
                      .engine_lx = lit->lux,
                      .law = lit->law,
                      .executed = std::string(exported.verified),
                      .rendered = exported.verified.starts_with("rendered")});
    }
  }
  return rows;
}

}  // namespace lightcal::app
