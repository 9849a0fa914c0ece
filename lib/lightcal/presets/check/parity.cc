// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/parity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/light/axial_shape.h"
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

std::optional<Lit> LitBy(const Emission& emission, const ParityPlace& place) {
  if (emission.lux) return Lit{*emission.lux, "no falloff"};
  if (!emission.candela) return std::nullopt;
  const double d = place.separation_m;
  const double shape = AxialShapeFactor(emission.shape, d);
  const bool flat = emission.shape.outline != AxialShape::Outline::kPoint;
  const double per_candela =
      emission.falloff ? emission.falloff->per_candela(Metres(d), Metres(emission.range_m))
                       : 1.0 / (d * d);
  return Lit{*emission.candela * shape * per_candela,
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

std::optional<Lit> LitIn(const EngineExport& exported, std::size_t index, const FittedLight& lamp,
                         const ParityPlace& place) {
  if (EmissionLaw* emission = exported.engine->emission) {
    return LitBy(emission(exported.derived[index], lamp.kind, place.axial_part), place);
  }
  const auto read = std::ranges::find(exported.read_back, lamp.name, &EngineLight::name);
  if (read == exported.read_back.end()) return std::nullopt;
  return LitBy(*read, place);
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
                      .executed = std::string(exported.engine->verified),
                      .rendered = exported.engine->verified.starts_with("rendered")});
    }
  }
  return rows;
}

}  // namespace lightcal
