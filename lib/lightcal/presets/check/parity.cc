// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/parity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/light/axial_shape.h"
#include "lightcal/presets/blender_sphere.h"
#include "lightcal/presets/rig.h"
#include "lightcal/records/light_curve.h"

namespace lightcal {
namespace {

// Where the lamp is compared.
struct ParityPlace {
  double distance_m = 0.0;    // from the reference point; 0 at infinity
  double separation_m = 1.0;  // from the effective source
  double lux = 0.0;           // of the lamp alone
  double axial_part = 1.0;    // intensity on the axis over that of the peak
};

std::optional<ParityPlace> PlaceOf(const FittedLight& lamp) {
  if (lamp.kind == LightKind::kDirectional || lamp.kind == LightKind::kDome) {
    if (!lamp.illuminance_lx || !(lamp.illuminance_lx->value > 0.0)) return std::nullopt;
    return ParityPlace{.distance_m = 0.0,
                       .separation_m = 1.0,
                       .lux = lamp.illuminance_lx->value,
                       .axial_part = 1.0};
  }
  LightFile alone;
  alone.lights = {lamp};
  Warnings said_by_export;
  const auto punctual = PunctualLightsFrom(alone, said_by_export);
  const auto curve = LightCurve::Of(lamp);
  if (!punctual || !curve) return std::nullopt;
  const Rig rig = BuildRig(alone, *punctual);
  ParityPlace place{.distance_m = rig.distance.value(),
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

// ---- lux and its law, in words ----

struct Lit {
  double lux = 0.0;
  std::string law;
};

std::string InverseSquare(double range_m) {
  if (!(range_m > 0.0)) return "1/d²";
  return "1/d², range " + RoundedText(range_m, 3) + " m";
}

// Of what a spot is told, on its axis.
double OnAxis(const std::optional<ConeOfLaw>& cone) { return cone ? ConeAt(*cone, 1.0) : 1.0; }

std::optional<Lit> LitBy(const Emission& emission, const ParityPlace& place) {
  if (emission.lux) return Lit{*emission.lux, "no falloff"};
  if (!emission.candela) return std::nullopt;
  const double d = place.separation_m;
  const double shape = AxialShapeFactor(emission.shape, d);
  const bool flat = emission.shape.outline != AxialShape::Outline::kPoint;
  const double per_candela =
      emission.falloff ? emission.falloff->per_candela(Metres(d), Metres(emission.range_m))
                       : 1.0 / (d * d);
  return Lit{*emission.candela * shape * per_candela * OnAxis(emission.cone),
             (flat ? "area light, " : "") + InverseSquare(emission.range_m)};
}

// The light of a file that was read back, seen from the place on its own axis.
std::optional<Lit> LitBy(const EngineLight& light, const ParityPlace& place) {
  const Vec3 point = light.position_m + light.aim * place.separation_m;
  const double lux = LuxAt(light, point, light.aim * -1.0);
  switch (light.kind) {
    case EngineLightKind::kSun:
    case EngineLightKind::kDome:
      return Lit{lux, "no falloff"};
    case EngineLightKind::kFlat:
    case EngineLightKind::kTube:
      return Lit{lux, "area light, 1/d²"};
    case EngineLightKind::kTable:
      return Lit{lux, "measured distribution, 1/d²"};
    default:
      return Lit{lux, InverseSquare(light.range_m)};
  }
}

// ---- off the axis ----

// A beam as it was measured, or a flat source, and directions in it.
struct Beam {
  PresetLight light;
  double end_rad = 0.0;
};

std::optional<Beam> BeamOf(const FittedLight& lamp) {
  const bool flat = lamp.kind == LightKind::kDisk || lamp.kind == LightKind::kRect;
  if (!flat && lamp.kind != LightKind::kSpot && lamp.kind != LightKind::kPhotometric) {
    return std::nullopt;
  }
  LightFile alone;
  alone.lights = {lamp};
  Warnings said_by_export;
  auto lights =
      PresetLightsFrom(alone, flat ? kEveryForm : EngineForms{.table = true}, {}, said_by_export);
  if (!lights) return std::nullopt;
  const PresetLight& light = lights->front();
  if (flat) {  // one whose size nobody stated has no form
    if (light.form != LightForm::kDisk && light.form != LightForm::kRect) return std::nullopt;
    return Beam{std::move(lights->front()), RadiansFromDegrees(95.0).value()};
  }
  const auto beam = light.table ? ProfileOf(*light.table) : light.beam;
  if (!beam) return std::nullopt;
  constexpr double kDark = 1e-3;
  double end = 0.0;
  for (std::size_t i = 0; i < beam->angle_rad.size(); ++i) {
    if (beam->most[i] > kDark) end = beam->angle_rad[i];
  }
  return Beam{std::move(lights->front()),
              std::min(std::numbers::pi, end + RadiansFromDegrees(5.0).value())};
}

struct OffAxis {
  double worst = 0.0, at_rad = 0.0;
};

// `engine(point, normal, cosine)`: lux there.
template <class Engine>
OffAxis WorstOffAxis(const Beam& beam, double separation_m, const Engine& engine) {
  constexpr int kAngles = 120, kTurns = 8;
  const LampAxes& axes = beam.light.axes;
  const auto at = [&](const Vec3& towards) {
    return beam.light.position_m() + towards * separation_m;
  };
  const double axial = IlluminanceAt(beam.light, at(axes.aim), axes.aim * -1.0).value();
  OffAxis out;
  if (!(axial > 0.0)) return out;
  for (int i = 0; i <= kAngles; ++i) {
    const double angle = beam.end_rad * i / kAngles;
    for (int j = 0; j < kTurns; ++j) {
      const double c = 2.0 * std::numbers::pi * j / kTurns;
      const Vec3 aside = axes.c0 * std::cos(c) + axes.c90 * std::sin(c);
      const Vec3 towards = axes.aim * std::cos(angle) + aside * std::sin(angle);
      const Vec3 point = at(towards);
      const Vec3 normal = towards * -1.0;
      const double off = std::abs(engine(point, normal, std::cos(angle)) -
                                  IlluminanceAt(beam.light, point, normal).value()) /
                         axial;
      if (off > out.worst) out = {off, angle};
    }
  }
  return out;
}

// Absent: lights that are no beam, and files that hold no place.
std::optional<OffAxis> OffAxisIn(const EngineExport& exported, std::size_t index,
                                 const FittedLight& lamp, const ParityPlace& place, double axial_lx,
                                 const std::optional<Beam>& beam) {
  if (!beam) return std::nullopt;
  if (EmissionLaw* emission = exported.engine->emission) {
    const Emission made = emission(exported.derived[index], lamp.kind, place.axial_part);
    if (made.table || made.shape.outline != AxialShape::Outline::kPoint) return OffAxis{};
    return WorstOffAxis(*beam, place.separation_m,
                        [&](const Vec3& /*point*/, const Vec3& /*normal*/, double cosine) {
                          const double part = made.cone ? ConeAt(*made.cone, cosine) : 1.0;
                          return axial_lx * part / OnAxis(made.cone);
                        });
  }
  const auto read = std::ranges::find(exported.read_back, lamp.name, &EngineLight::name);
  if (read == exported.read_back.end() || !read->placed) return std::nullopt;
  if (read->kind == EngineLightKind::kFlat) return OffAxis{};
  return WorstOffAxis(*beam, place.separation_m,
                      [&](const Vec3& point, const Vec3& normal, double /*cosine*/) {
                        return LuxAt(*read, point, normal);
                      });
}

std::optional<Lit> LitIn(const EngineExport& exported, std::size_t index, const FittedLight& lamp,
                         const ParityPlace& place) {
  if (EmissionLaw* emission = exported.engine->emission) {
    return LitBy(emission(exported.derived[index], lamp.kind, place.axial_part), place);
  }
  const auto read = std::ranges::find(exported.read_back, lamp.name, &EngineLight::name);
  if (read == exported.read_back.end()) return std::nullopt;
  auto lit = LitBy(*read, place);
  if (lit && lamp.kind == LightKind::kSphere && exported.engine->name == "blender") {
    const double lack =
        LackOfOldBlenderSphere(lamp.diameter_m.value_or(0.0) / 2.0, place.separation_m);
    lit->law += ", before 4.0 " + RoundedText(100.0 * lack, 2) + " % low";
  }
  return lit;
}

// ---- round about ----

double LuminanceOfVec(const Vec3& rgb) {
  return LuminanceOfRgb({rgb[0], rgb[1], rgb[2]}, RgbSpace::kSrgb);
}

// Ours: +Y front, +X right, +Z up.
constexpr std::array<std::string_view, 6> kWays = {"up", "down", "front", "right", "back", "left"};
constexpr std::array<Vec3, 6> kNormals = {
    {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {-1, 0, 0}}};

// A picture's lux round about: its own, and what its nine harmonics give.
struct SixWays {
  std::array<double, 6> own{}, harmonic{};
};

SixWays SixWaysOf(const EnvironmentPicture& picture) {
  SixWays out;
  const std::vector<Vec3> own = IrradianceOn(picture, kNormals);
  const Harmonics harmonics = RadianceHarmonics(picture, [](const Vec3& v) { return v; });
  for (std::size_t i = 0; i < kNormals.size(); ++i) {
    out.own[i] = LuminanceOfVec(own[i]);
    out.harmonic[i] = LuminanceOfVec(IrradianceOn(harmonics, kNormals[i]));
  }
  return out;
}

struct Around {
  std::vector<WayLux> ways;
  std::string law;
};

Around AroundIn(PanoramaLaw law, const SixWays& six) {
  Around out;
  if (law == PanoramaLaw::kNotKnown) return out;
  const bool traced = law == PanoramaLaw::kTraced;
  out.law = traced ? "the picture itself" : "nine harmonics of the picture";
  for (std::size_t i = 0; i < kWays.size(); ++i) {
    out.ways.push_back({kWays[i], six.own[i], traced ? six.own[i] : six.harmonic[i]});
  }
  return out;
}

}  // namespace

std::vector<ParityRow> ParityOf(
    const LightFile& lights, const std::vector<EngineExport>& exports,
    const std::vector<std::shared_ptr<const EnvironmentPicture>>& environments) {
  std::vector<ParityRow> rows;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    const auto place = PlaceOf(lamp);
    if (!place) continue;
    const auto beam = BeamOf(lamp);
    std::optional<SixWays> six;
    const auto picture = i < environments.size() ? environments[i] : nullptr;
    if (picture && lamp.kind == LightKind::kDome) six = SixWaysOf(*picture);
    for (const EngineExport& exported : exports) {
      if (six) {
        Around around = AroundIn(exported.engine->panorama, *six);
        if (around.ways.empty()) continue;
        ParityRow row;
        row.light = lamp.name;
        row.engine = std::string(exported.engine->title);
        row.expected_lx = around.ways.front().expected_lx;
        row.engine_lx = around.ways.front().engine_lx;
        row.law = std::move(around.law);
        row.executed = std::string(exported.engine->verified);
        row.rendered = exported.engine->verified.starts_with("rendered");
        row.around = std::move(around.ways);
        rows.push_back(std::move(row));
        continue;
      }
      const auto lit = LitIn(exported, i, lamp, *place);
      if (!lit || !std::isfinite(lit->lux)) continue;
      const auto off_axis = OffAxisIn(exported, i, lamp, *place, lit->lux, beam);
      rows.push_back(
          {.light = lamp.name,
           .engine = std::string(exported.engine->title),
           .distance_m = place->distance_m,
           .expected_lx = place->lux,
           .engine_lx = lit->lux,
           .law = lit->law,
           .executed = std::string(exported.engine->verified),
           .rendered = exported.engine->verified.starts_with("rendered"),
           .off_axis = off_axis ? std::optional(off_axis->worst) : std::nullopt,
           .off_axis_deg = off_axis ? DegreesFromRadians(Radians(off_axis->at_rad)) : 0.0});
    }
  }
  return rows;
}

}  // namespace lightcal
