// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/light/models/source_model.h"
#include "lightcal/photometry/lambert.h"
#include "lightcal/presets/light_distribution.h"
#include "lightcal/presets/turned_panorama.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal {
namespace {

// ---- which form, and how large ----

bool Known(const std::optional<double>& length) { return length && *length > 0.0; }

bool TakeNativeForm(const FittedLight& lamp, const EngineForms& forms, PresetLight& light) {
  switch (lamp.kind) {
    case LightKind::kSphere:
      if (!forms.sphere || !Known(lamp.diameter_m)) return false;
      light.form = LightForm::kSphere;
      light.radius_m = *lamp.diameter_m / 2.0;
      return true;
    case LightKind::kDisk:
      if (!forms.disk || !Known(lamp.diameter_m)) return false;
      light.form = LightForm::kDisk;
      light.radius_m = *lamp.diameter_m / 2.0;
      return true;
    case LightKind::kRect:
      if (!forms.rect || !Known(lamp.width_m) || !Known(lamp.height_m)) return false;
      light.form = LightForm::kRect;
      light.width_m = *lamp.width_m;
      light.height_m = *lamp.height_m;
      return true;
    case LightKind::kTube:
      if (!forms.tube || !Known(lamp.length_m) || !Known(lamp.radius_m)) return false;
      light.form = LightForm::kTube;
      light.length_m = *lamp.length_m;
      light.radius_m = *lamp.radius_m;
      return true;
    case LightKind::kSpot:
    case LightKind::kPhotometric:
      if (!forms.table || !lamp.distribution) return false;
      light.form = LightForm::kTable;
      return true;
    case LightKind::kDome:
      if (!forms.dome) return false;
      light.form = LightForm::kDome;
      return true;
    case LightKind::kPoint:
    case LightKind::kDirectional:
      break;
  }
  return false;
}

void TakePunctualForm(const PunctualLight& punctual, PresetLight& light) {
  light.substitution = punctual.substitution;
  light.strays = punctual.strays;
  switch (punctual.type) {
    case PunctualType::kPoint:
      light.form = LightForm::kPoint;
      break;
    case PunctualType::kSpot:
      light.form = LightForm::kSpot;
      break;
    case PunctualType::kDirectional:
      light.form = LightForm::kDirectional;
      break;
  }
}

bool TakeSquareForDisk(const FittedLight& lamp, const EngineForms& forms, PresetLight& light) {
  if (lamp.kind != LightKind::kDisk || !forms.rect || !Known(lamp.diameter_m)) return false;
  light.form = LightForm::kRect;
  light.width_m = light.height_m = *lamp.diameter_m / 2.0 * std::sqrt(std::numbers::pi);
  light.substitution =
      "a disk exported as a square of its area: intensity, flux and luminance are kept; on its "
      "axis 0.7 % low at one diameter, 0.3 % at two, nothing far away";
  return true;
}

bool IsFlat(LightKind kind) { return kind == LightKind::kDisk || kind == LightKind::kRect; }

// A flat source whose engine has no face, or whose size nobody stated.
std::string FlatAsSpot(const std::string& error) {
  return "a flat source as the engine's own spot: right on the axis beyond 5 times its size, " +
         (error.empty() ? "off the axis as well" : error) + ", shadows are hard";
}

// The engine's own cone for the lamp, not for what another engine's spot makes of it; says what is
// left.
void RefitSpot(const FittedLight& lamp, EngineConeLaw law, const LearntEngine* engine,
               PresetLight& light) {
  light.cone.cone = light.punctual.cone;
  const bool flat = IsFlat(lamp.kind);
  light.beam = lamp.distribution ? ProfileOf(lamp.distribution->table)
               : flat            ? LambertianProfile()
                                 : std::optional(ProfileOf(light.punctual.cone));
  if (!light.beam) return;
  const LearntCone* const learnt = engine != nullptr ? engine->ConeWrittenFor(law) : nullptr;
  light.cone = learnt != nullptr ? learnt->ToWrite(*light.beam) : RefitCone(law, *light.beam);
  const std::string error = ConeErrorText(light.cone);
  if (flat) {
    light.substitution = FlatAsSpot(error);
    light.strays = error.empty() ? 0.0 : light.cone.worst;
    return;
  }
  if (error.empty() || (law == EngineConeLaw::kSquared && learnt == nullptr)) return;
  light.strays = light.cone.worst;
  light.substitution =
      std::string(lamp.distribution ? DistributionWords(lamp) + ", round about its aim"
                                    : "a spot of squared-linear falloff") +
      " as the engine's own cone, refitted: right on the axis, " + error;
}

// Where a picture of the beam strays less than the engine's own cone.
void ProjectSpot(PresetLight& light) {
  if (!light.beam || !light.beam->squared || light.cone.worst <= kConeGoodEnough) return;
  const auto projected = ProjectionOf(*light.beam->squared);
  if (!projected || projected->worst >= light.cone.worst) return;
  light.projected = projected;
  const std::string error = ErrorOffAxis(projected->worst, projected->worst_at);
  light.strays = error.empty() ? 0.0 : projected->worst;
  light.substitution =
      error.empty() ? ""
                    : "a spot of squared-linear falloff as a picture of it, projected: " + error;
}

// Of an engine whose distributions are round about the aim.
Result<void> MakeRound(const FittedLight& lamp, PresetLight& light) {
  light.beam = ProfileOf(*light.table);
  const double axial = light.table->At(Radians(0.0), Radians(0.0)).value();
  const bool lit = axial > 0.0;
  const double against = lit ? axial : light.table->peak().intensity.value();
  auto round = RoundAboutAim(*light.table);
  if (!round) return Propagate(std::move(round));
  light.table = std::move(round->table);
  const double worst = round->worst_cd / against;
  const std::string error = ErrorOffAxis(worst, round->worst_at, lit ? "axial" : "largest");
  if (error.empty()) return {};
  light.strays = worst;
  light.substitution = std::string(DistributionWords(lamp)) +
                       " as its mean round about the aim, flux kept: " + error;
  return {};
}

void ChooseForm(const FittedLight& lamp, const EngineForms& forms, const PresetOptions& options,
                PresetLight& light) {
  const SpotForm spots = options.spots;
  EngineForms permitted = forms;
  permitted.table = forms.table && spots != SpotForm::kCone;
  if (TakeNativeForm(lamp, permitted, light) || TakeSquareForDisk(lamp, forms, light)) return;
  TakePunctualForm(light.punctual, light);
  if (light.form != LightForm::kSpot) return;
  RefitSpot(lamp, forms.cone, options.engine.get(), light);
  const bool strays = forms.spots_by_table && light.cone.worst > kConeGoodEnough;
  if (lamp.kind == LightKind::kSpot && permitted.table && (spots == SpotForm::kIes || strays)) {
    light.form = LightForm::kTable;
    light.substitution.clear();
    light.strays = 0.0;
  }
  if (forms.projects_spots && spots != SpotForm::kCone) ProjectSpot(light);
}

// ---- how bright ----

double AreaSeenAlongAxis(const PresetLight& light) {
  switch (light.form) {
    case LightForm::kSphere:
    case LightForm::kDisk:
      return std::numbers::pi * light.radius_m * light.radius_m;
    case LightForm::kRect:
      return light.width_m * light.height_m;
    case LightForm::kTube:
      return 2.0 * light.radius_m * light.length_m;
    default:
      return 0.0;
  }
}

double LumensPerCandela(const PresetLight& light) {
  switch (light.form) {
    case LightForm::kPoint:
    case LightForm::kSphere:
      return 4.0 * std::numbers::pi;
    case LightForm::kSpot:
      return SolidAngleOfSpot(light.punctual.cone, SpotFalloff::kSquaredLinear).value();
    case LightForm::kDisk:
    case LightForm::kRect:
      return std::numbers::pi;
    case LightForm::kTube:
      return std::numbers::pi * std::numbers::pi;
    default:
      return 0.0;
  }
}

void MeasureInfinite(const FittedLight& lamp, PresetLight& light) {
  light.lux = light.punctual.photometric;
  if (light.form == LightForm::kDome) {
    light.nits = light.lux / std::numbers::pi;
    return;
  }
  if (lamp.kind != LightKind::kDirectional || !Known(lamp.angular_diameter_deg)) return;
  light.angular_diameter_deg = lamp.angular_diameter_deg;
  const double sine = std::sin(RadiansFromDegrees(*lamp.angular_diameter_deg / 2.0).value());
  light.nits = light.lux / (std::numbers::pi * sine * sine);
}

Result<void> Measure(const FittedLight& lamp, const EngineForms& forms, PresetLight& light) {
  const PunctualLight& punctual = light.punctual;
  if (punctual.photometric_u95) {
    light.relative_u95 = *punctual.photometric_u95 / punctual.photometric;
  }
  if (light.form == LightForm::kDirectional || light.form == LightForm::kDome) {
    MeasureInfinite(lamp, light);
    return {};
  }
  if (light.form == LightForm::kTable) {
    auto table = DistributionOf(lamp);
    if (!table) return Propagate(std::move(table));
    light.table = *std::move(table);
    if (forms.round_tables) {
      if (auto round = MakeRound(lamp, light); !round) return Propagate(std::move(round));
    }
    light.candela = light.table->peak().intensity.value();
    light.lumens = light.table->Flux().value();
    return {};
  }
  light.candela = punctual.photometric;
  light.lumens = light.candela * LumensPerCandela(light);
  if (const double area = AreaSeenAlongAxis(light); area > 0.0) light.nits = light.candela / area;
  return {};
}

// ---- what it casts ----

std::optional<SourceModel> AreaModel(const PresetLight& light) {
  switch (light.form) {
    case LightForm::kSphere:
      return SphereSource{light.radius_m};
    case LightForm::kDisk:
      return DiskSource{light.radius_m};
    case LightForm::kRect:
      return RectSource{light.width_m / 2.0, light.height_m / 2.0};
    case LightForm::kTube:
      return TubeSource{light.length_m / 2.0, light.radius_m};
    default:
      return std::nullopt;
  }
}

double TableLux(const PresetLight& light, const Vec3& to_point, const Vec3& normal) {
  const double d2 = Dot(to_point, to_point);
  if (!(d2 > 0.0)) return 0.0;
  const double d = std::sqrt(d2);
  const double gamma = std::acos(std::clamp(Dot(to_point, light.axes.aim) / d, -1.0, 1.0));
  const double c = std::atan2(Dot(to_point, light.axes.c90), Dot(to_point, light.axes.c0));
  const double candela =
      light.table->At(Radians(c < 0.0 ? c + 2.0 * std::numbers::pi : c), Radians(gamma)).value();
  return candela * std::max(0.0, -Dot(to_point, normal)) / (d2 * d);
}

// What the preset's own numbers give.
Lux LuxAsWritten(const PresetLight& light, const Vec3& point, const Vec3& normal) {
  if (light.form == LightForm::kDome && light.environment) {
    const Vec3 rgb = IrradianceOn(light.shown ? *light.shown : *light.environment, normal);
    return Lux(LuminanceOfRgb({rgb[0], rgb[1], rgb[2]}, RgbSpace::kSrgb));
  }
  if (light.form == LightForm::kDome) return Lux(light.lux);
  const Vec3 to_point = point - light.position_m();
  if (light.form == LightForm::kTable) return Lux(TableLux(light, to_point, normal));
  const auto model = AreaModel(light);
  if (!model) return IlluminanceAt(light.punctual, point, normal);
  const SourceFrame frame = SourceFrame::Facing(light.aim(), light.axes.c0);
  return Lux(light.candela *
             LuxPerCandela(*model, Receiver<double>{frame.Of(to_point), frame.Of(normal)}));
}

// Divides everything the engine is told by what it multiplies with, and hangs a dome's picture so
// that it shows as it was.
void UndoEngine(const LearntEngine& engine, const FittedLight& lamp, PresetLight& light) {
  const double factor =
      engine.FactorOf(lamp.kind, SurfaceOf(lamp.kind, lamp.diameter_m, lamp.width_m, lamp.height_m,
                                           lamp.length_m, lamp.radius_m));
  const double k = 1.0 / factor;
  light.engine_factor = factor;
  for (double* value : {&light.candela, &light.lux, &light.nits, &light.lumens,
                        &light.punctual.photometric, &light.punctual.intensity}) {
    *value *= k;
  }
  for (auto* u95 : {&light.punctual.photometric_u95, &light.punctual.intensity_u95}) {
    if (*u95) **u95 *= k;
  }
  if (!light.environment) return;
  auto picture = std::make_shared<EnvironmentPicture>(*light.environment);
  for (float& sample : picture->rgb) sample = static_cast<float>(sample * k);
  for (double& sample : picture->small) sample *= k;
  light.environment = std::move(picture);
  if (const auto turn = engine.TurnOfDomes()) {
    light.shown = std::move(light.environment);
    light.environment = std::make_shared<EnvironmentPicture>(
        ForEngineThatTurns(*light.shown, turn->way, turn->turn_deg));
  }
}

}  // namespace

Result<std::vector<PresetLight>> PresetLightsFrom(const LightFile& file, const EngineForms& forms,
                                                  const PresetOptions& options,
                                                  Warnings& warnings) {
  Warnings of_punctual;
  auto punctual = PunctualLightsFrom(file, of_punctual, options.color);
  if (!punctual) return Propagate(std::move(punctual));
  for (Warning& warning : of_punctual) {
    if (warning.code != "substituted") warnings.push_back(std::move(warning));
  }
  std::vector<PresetLight> lights;
  for (std::size_t i = 0; i < punctual->size(); ++i) {
    PresetLight light;
    light.punctual = std::move((*punctual)[i]);
    const FittedLight& lamp = file.lights[i];
    const Vec3 along = lamp.axis.value_or(Vec3{});
    // A tube without aim hangs as its axis says, shining to its side.
    if (lamp.axis && !lamp.aim) light.punctual.aim = AxesOfAim(along, light.punctual.aim).c0;
    light.axes = AxesOfAim(light.punctual.aim, along);
    const auto picture = i < options.environments.size() ? options.environments[i] : nullptr;
    EngineForms able = forms;
    able.dome = forms.dome || (forms.pictured_dome && picture && options.into.empty());
    ChooseForm(lamp, able, options, light);
    if (light.form == LightForm::kDome) light.environment = picture;
    if (auto measured = Measure(lamp, forms, light); !measured) {
      return Propagate(std::move(measured));
    }
    if (!light.substitution.empty() && !IsSpotWithoutCone(lamp)) {
      const bool shape_only =
          lamp.kind == LightKind::kSpot && !lamp.distribution && light.form == LightForm::kSpot;
      warnings.push_back({shape_only ? "cone_profile" : "substituted", light.name(),
                          light.substitution, light.strays});
    }
    if (options.engine) UndoEngine(*options.engine, lamp, light);
    lights.push_back(std::move(light));
  }
  return lights;
}

Lux IlluminanceAt(const PresetLight& light, const Vec3& point, const Vec3& normal) {
  return Lux(light.engine_factor * LuxAsWritten(light, point, normal).value());
}

}  // namespace lightcal
