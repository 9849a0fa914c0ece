// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/scene_of_session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "lightcal/core/uncertain.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal::fit {
namespace {

template <class T>
void KeepLargest(std::optional<T>& kept, const std::optional<T>& next) {
  if (next && (!kept || *next > *kept)) kept = next;
}

// The worst of what the light's meters state.
void AddMeters(const Session& session, const LightDescription& light, Scene& scene) {
  for (const MeterDescription& meter : session.meters) {
    const bool used = std::any_of(
        session.readings.begin(), session.readings.end(), [&](const SessionReading& row) {
          return row.reading.light == light.name && row.reading.meter == meter.name;
        });
    if (!used) continue;
    KeepLargest(scene.spectral_f1, meter.spectral_f1);
    KeepLargest(scene.cosine_f2, meter.cosine_f2);
    KeepLargest(scene.head_radius, meter.head_radius);
    if (meter.window_s && (!scene.time.window_s || *meter.window_s < *scene.time.window_s)) {
      scene.time.window_s = meter.window_s;
    }
  }
}

std::optional<double> AmbientRatio(const Observations& observations) {
  double off = 0.0;
  int count = 0;
  double dimmest = std::numeric_limits<double>::infinity();
  for (const Observation& row : observations.rows) {
    if (row.lit && row.raw_lx > 0.0) dimmest = std::min(dimmest, row.raw_lx);
    if (row.lit) continue;
    off += row.measured_lx;
    ++count;
  }
  const auto is_subtracted = [](const Observation& o) { return o.ambient_subtracted; };
  const bool subtracted =
      std::any_of(observations.rows.begin(), observations.rows.end(), is_subtracted) &&
      std::all_of(observations.rows.begin(), observations.rows.end(), [&](const Observation& o) {
        return is_subtracted(o) || (o.lit && o.differenced);
      });
  if (count == 0 && subtracted) return 0.0;
  if (count == 0 || !std::isfinite(dimmest)) return std::nullopt;
  return off / count / dimmest;
}

// Between the source's axis and the meter; 0 where nobody says it.
double EmissionOf(const LightDescription& light, const Observation& row) {
  if (row.off_axis) {
    const Vec3& p = row.off_axis->at.position;
    const bool tube = std::holds_alternative<TubeSource>(row.off_axis->source);
    return tube ? std::atan2(std::abs(p[0]), std::hypot(p[1], p[2]))
                : std::atan2(std::hypot(p[0], p[1]), p[2]);
  }
  if (light.kind != LightKind::kPhotometric) return 0.0;
  if (row.off_axis_rad != 0.0) return std::abs(row.off_axis_rad);
  if (!light.aim || !light.position_m || !row.position_m) return 0.0;
  const Vec3 away = *row.position_m - *light.position_m;
  return std::atan2(Length(Cross(*light.aim, away)), Dot(*light.aim, away));
}

// What the light is built like, where its kind says it.
std::optional<Fixture> FixtureOf(const LightDescription& light) {
  if (light.fixture) return light.fixture;
  switch (light.kind) {
    case LightKind::kSphere:
      return Fixture::kBulb;
    case LightKind::kDisk:
    case LightKind::kRect:
    case LightKind::kTube:
      return Fixture::kPanel;
    case LightKind::kPhotometric:
      return light.position_m ? std::optional(Fixture::kLuminaire) : std::nullopt;
    default:
      return std::nullopt;
  }
}

// Of a lamp that nobody says more of than its photometric file, whose intensities are about the
// middle of its luminous opening (LM-63-2002, CIE 121): no mount and no diffuser before it counts,
// but its light may start somewhat deeper. By judgement: twice that of a mounted luminaire.
constexpr OffsetPart kFromOpening = {1.0, 0.0, 0.04};

// Whether the lamp glows; absent where nobody says. A chip on a board and a panel do not.
std::optional<bool> BurnsFilament(const Session& session, const LightDescription& light) {
  const LampClass lamp = ClassOfLamp(session, light.name);
  if (lamp != LampClass::kUnknown) return lamp == LampClass::kTungsten;
  const std::optional<Fixture> fixture = FixtureOf(light);
  if (fixture == Fixture::kCobBare || fixture == Fixture::kPanel) return false;
  return std::nullopt;
}

// The worst of the light's pictures.
void AddPicture(const CaptureDescription& capture, std::optional<ScenePicture>& kept) {
  ScenePicture one;
  one.rows_s = capture.rows_s;
  one.glare = capture.lens_glare;
  one.flat_field = capture.found.flat_field;
  one.mean_over_patch = capture.found.mean_over_patch;
  one.off_middle_rad = capture.found.off_middle_rad;
  one.exposure_s = capture.found.exposure_s;
  if (!one.exposure_s && !capture.exposure_s.empty()) {
    one.exposure_s = std::ranges::min(capture.exposure_s);
  }
  if (!kept) {
    kept = one;
    return;
  }
  KeepLargest(kept->mean_over_patch, one.mean_over_patch);
  KeepLargest(kept->glare, one.glare);
  // Where one of them is not known the worst is that default.
  if (!kept->off_middle_rad || !one.off_middle_rad) {
    kept->off_middle_rad.reset();
  } else {
    KeepLargest(kept->off_middle_rad, one.off_middle_rad);
  }
  kept->flat_field = kept->flat_field && one.flat_field;
  const auto keep_least = [](std::optional<double>& least, const std::optional<double>& next) {
    if (next && (!least || *next < *least)) least = next;
  };
  keep_least(kept->exposure_s, one.exposure_s);
  keep_least(kept->rows_s, one.rows_s);
}

// Whether such pictures become readings of illuminance.
bool ReadsTheLight(CaptureUse use) {
  return use == CaptureUse::kCard || use == CaptureUse::kSource;
}

// Who read, with what: a person's meter, a manufacturer, a camera.
void AddTime(const Session& session, const LightDescription& light, Scene& scene) {
  scene.time = TimeOfLamp(session, light);
  scene.time.own_lamp = false;
  bool pictures = false;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light != light.name || !row.reading.illuminance) continue;
    scene.time.own_lamp = scene.time.own_lamp || row.reading.meter != kDataSheetMeter;
    pictures = pictures || row.reading.quality == MeterQuality::kDerived;
  }
  if (!pictures) return;
  for (const CaptureDescription& capture : session.captures) {
    if (capture.light != light.name || !ReadsTheLight(capture.use)) continue;
    if (capture.anchor_illuminance) continue;  // a meter gives the level, the picture the colour
    AddPicture(capture, scene.picture);
  }
}

// Flux over axial intensity, where a cone or a table tells it.
std::optional<double> FluxOverIntensity(const LightDescription& light) {
  if (light.distribution) {
    const IntensityTable& table = *light.distribution;
    const double peak = table.peak().intensity.value();
    return peak > 0.0 ? std::optional(table.Flux().value() / peak) : std::nullopt;
  }
  if (light.kind != LightKind::kSpot || !light.outer || light.beam) return std::nullopt;
  const SpotCone cone{light.inner.value_or(Radians(0.0)), *light.outer};
  return SolidAngleOfSpot(cone, SpotFalloff::kSquaredLinear).value();
}

LampSpread SpreadOf(const LightDescription& light) {
  return {light.kind, light.fixture, light.beam, FluxOverIntensity(light)};
}

// The largest distance that somebody stood from the lamp.
Metres FarthestRead(const Session& session, const LightDescription& light) {
  double farthest = 0.0;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light.name || reading.meter == kDataSheetMeter) continue;
    if (reading.distance) farthest = std::max(farthest, reading.distance->value());
    if (reading.position_m && light.position_m) {
      farthest = std::max(farthest, Length(*reading.position_m - *light.position_m));
    }
  }
  return Metres(farthest);
}

// What is known beforehand of the walls' light and of where the lamp's starts.
void AddPriors(const Session& session, const LightDescription& light,
               const Observations& observations, Scene& scene) {
  const auto own = [](const Observation& o) { return o.lit && o.sees_walls; };
  scene.over_ground = session.surroundings == Surroundings::kOutdoors;
  // Behind a card outdoors lies what else shines there more than the ground.
  const auto carded = [](const Observation& o) { return o.differenced || o.behind_card; };
  scene.no_walls = std::ranges::none_of(observations.rows, own) ||
                   (scene.over_ground && std::ranges::any_of(observations.rows, carded));
  if (HasDistanceLaw(light.kind) && !scene.no_walls) scene.walls = WallPriorsOf(session, light);
  // A table of a film fixture gives its offset with its own first distance.
  const auto held = [](const Observation& o) { return o.lit && !o.data_sheet; };
  if (!light.fixture && std::ranges::none_of(observations.rows, held)) return;
  if (HasDistanceLaw(light.kind)) scene.makes = PossibleMakes(SpreadOf(light));
  const std::optional<Fixture> fixture = FixtureOf(light);
  if (!fixture && light.kind == LightKind::kPhotometric) {
    scene.offsets = {kFromOpening};
  } else {
    const auto parts = OffsetParts(fixture);
    scene.offsets.assign(parts.begin(), parts.end());
  }
  // Distances end at a ball's surface or at its centre; nobody said.
  if (light.kind == LightKind::kSphere && light.diameter && scene.offsets.size() == 1) {
    OffsetPart centre = scene.offsets.front();
    centre.mean_m += 0.5 * light.diameter->value();
    scene.offsets.front().weight = centre.weight = 0.5;
    scene.offsets.push_back(centre);
  }
}

}  // namespace

SceneTime TimeOfLamp(const Session& session, const LightDescription& light) {
  SceneTime time;
  time.filament = BurnsFilament(session, light);
  time.daylight = ClassOfLamp(session, light.name) == LampClass::kDaylight;
  if (light.in_time.minutes_on) time.on_for_s = 60.0 * *light.in_time.minutes_on;
  time.flicker_hz = light.in_time.flicker_hz;
  time.ripple = light.in_time.flicker_depth;
  time.duty = light.in_time.pwm_duty;
  time.haze_per_metre = session.haze_per_metre;
  return time;
}

std::optional<StatedRoom> StatedRoomOf(const Session& session) {
  if (!session.room) return std::nullopt;
  constexpr double kU95 = 0.2;  // of the reflectance, as people guess it
  const double rho = session.room->reflectance;
  return StatedRoom{session.room->size_m, rho,
                    session.room->reflectance_u95.value_or(kU95 * rho) / kZ95};
}

std::vector<WallHypothesis> WallPriorsOf(const Session& session, const LightDescription& light) {
  if (session.surroundings == Surroundings::kOutdoors) return GroundPriors(SpreadOf(light));
  return WallPriors(SpreadOf(light), StatedRoomOf(session), FarthestRead(session, light));
}

Scene SceneOfSession(const Session& session, const LightDescription& light,
                     const Observations& observations, int patches) {
  Scene scene;
  scene.kind = light.kind;
  scene.size = {light.diameter, light.width, light.height, light.length, light.radius};
  scene.position_m = light.position_m;
  scene.aim = light.aim;
  scene.inner = light.inner;
  scene.outer = light.outer;
  scene.beam = light.beam;
  for (const Observation& row : observations.rows) {
    if (!row.lit) continue;
    scene.poses.push_back({row.distance_m, row.tilt_rad, row.measured_from_center, row.differenced,
                           row.position_m, EmissionOf(light, row), row.of_luminance,
                           row.table_error});
    if (row.distance_sigma_m) {
      KeepLargest(scene.distance_error_m, std::optional(kZ95 * *row.distance_sigma_m));
    }
  }
  scene.distances = CountDistinctDistances(observations.rows);
  scene.ambient_ratio = AmbientRatio(observations);
  if (session.room) scene.room = RoomBox{session.room->size_m, session.room->reflectance, patches};
  if (light.distribution) scene.table_step_rad = light.distribution->LargestStep().value();
  scene.dark = session.surroundings == Surroundings::kDark;
  AddPriors(session, light, observations, scene);
  AddTime(session, light, scene);
  AddMeters(session, light, scene);
  return scene;
}

}  // namespace lightcal::fit
