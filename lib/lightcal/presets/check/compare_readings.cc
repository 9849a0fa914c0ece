// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/compare_readings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/light/lamp_axes.h"
#include "lightcal/light/pattern_doubt.h"
#include "lightcal/presets/blender_sphere.h"
#include "lightcal/records/light_curve.h"

namespace lightcal {
namespace {

std::vector<const Reading*> ReadingsOf(const Session& session, const std::string& light) {
  std::vector<const Reading*> out;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light == light) out.push_back(&row.reading);
  }
  return out;
}

// A lamp where its readings found it, else as the session has it. A lamp that is turned somewhere
// has its effective source behind the place its distances count from, by its offset; of any other
// that is a radius.
struct MeteredLamp {
  const LightDescription& description;
  const FittedLight& fitted;
  Vec3 place_m{}, aim{0.0, 0.0, -1.0};
  LampAxes axes{};
  bool turned = false;
  bool has_place = false, has_aim = false;  // somebody says them, or the readings did
  double offset_m = 0.0, surface_m = 0.0;   // surface: of a sphere that distances count from
};

MeteredLamp MeteredLampOf(const LightDescription& description, const FittedLight& fitted) {
  MeteredLamp lamp{description, fitted};
  lamp.place_m = fitted.position_m.value_or(description.position_m.value_or(Vec3{}));
  lamp.has_place = fitted.position_m || description.position_m;
  const LightKind kind = description.kind;
  const auto aim = fitted.aim ? fitted.aim : description.aim;
  lamp.has_aim = aim.has_value();
  if (aim && kind != LightKind::kDome) lamp.aim = *aim;
  if (!description.aim && kind == LightKind::kTube && description.axis) {
    lamp.aim = AxesOfAim(*description.axis).c0;  // any that is square to it
  }
  lamp.axes = AxesOfAim(lamp.aim, description.axis.value_or(Vec3{}));
  lamp.turned = description.aim || kind == LightKind::kSpot || kind == LightKind::kDisk ||
                kind == LightKind::kRect || kind == LightKind::kPhotometric;
  if (fitted.distance_offset_m) lamp.offset_m = fitted.distance_offset_m->value;
  lamp.surface_m = SurfaceRadius_m(fitted);
  return lamp;
}

// Where a meter stood so far from the lamp and off its axis, one place for each side it may have
// been on; nobody says which.
std::vector<Vec3> WaysFrom(const MeteredLamp& lamp, double off_axis_rad) {
  constexpr int kSides = 16;
  if (off_axis_rad == 0.0) return {lamp.aim};
  std::vector<Vec3> ways;
  for (int i = 0; i < kSides; ++i) {
    const double round = 2.0 * std::numbers::pi * i / kSides;
    const Vec3 aside = lamp.axes.c0 * std::cos(round) + lamp.axes.c90 * std::sin(round);
    ways.push_back(lamp.aim * std::cos(off_axis_rad) + aside * std::sin(off_axis_rad));
  }
  return ways;
}

// A photometric file's light where the lamp hangs, turned about its aim as it does.
EngineLight PlacedLike(const MeteredLamp& lamp, EngineLight light) {
  light.position_m = lamp.place_m - lamp.aim * (lamp.turned ? lamp.offset_m : 0.0);
  light.offset_m = lamp.turned ? 0.0 : lamp.offset_m;
  light.aim = lamp.aim;
  light.x = lamp.axes.c0;
  light.y = lamp.axes.c90;
  return light;
}

// The lamp where the file has it, in as far as nobody says where it stands: a preset is there for
// being moved, and what was read at a distance from a lamp holds wherever that goes.
MeteredLamp WhereFileHas(const MeteredLamp& lamp, const EngineLight& light) {
  MeteredLamp there = lamp;
  if (!light.placed || light.kind == EngineLightKind::kDome) return there;
  const double length = Length(light.aim);
  if (!lamp.has_aim && length > 0.0) {
    there.aim = light.aim * (1.0 / length);
    there.axes = AxesOfAim(there.aim, light.x);
  }
  if (!lamp.has_place) {
    there.place_m = light.position_m + there.aim * (lamp.turned ? lamp.offset_m : 0.0);
  }
  return there;
}

// As by distance: of a lamp that is not turned the offset is a radius, whatever told the place.
Vec3 Outwards(const MeteredLamp& lamp, const Vec3& point, double offset_m) {
  const Vec3 way = point - lamp.place_m;
  const double distance = Length(way);
  if (lamp.turned || !(distance > 0.0)) return point;
  return point + way * (offset_m / distance);
}

// What the file's lights give where the meter stood, facing the lamp unless it says otherwise.
double Predicted(const std::vector<EngineLight>& lights, const MeteredLamp& lamp,
                 const Reading& reading) {
  double sum = 0.0;
  for (const EngineLight& light : lights) {
    if (!light.name.empty() && light.name != lamp.fitted.name) continue;
    const bool dome = lamp.description.kind == LightKind::kDome;
    if (light.name.empty() && light.placed && !dome) continue;  // surroundings
    const EngineLight placed = light.placed ? light : PlacedLike(lamp, light);
    if (reading.position_m && reading.normal) {
      const Vec3 normal = *reading.normal * (1.0 / Length(*reading.normal));
      sum += LuxAt(placed, Outwards(lamp, *reading.position_m, placed.offset_m), normal);
      continue;
    }
    const double d = (reading.distance ? reading.distance->value() : 1.0) + lamp.surface_m +
                     (lamp.turned ? 0.0 : placed.offset_m);
    const MeteredLamp there = WhereFileHas(lamp, placed);
    const std::vector<Vec3> ways = WaysFrom(there, reading.off_axis.value());
    double facing = 0.0;
    for (const Vec3& way : ways) facing += LuxAt(placed, there.place_m + way * d, way * -1.0);
    sum += facing / static_cast<double>(ways.size()) * std::cos(reading.tilt.value());
  }
  return sum;
}

// What the fit itself leaves of a row, in lux: its residual, and of a beam the thousandth of its
// peak at which every distribution ends (kDarkEnd of fit/beam).
double LeftAt(const ResidualRow& row) {
  constexpr double kBeamEnd = 1e-3;
  return std::max(std::abs(row.predicted_lx - row.measured_lx),
                  kBeamEnd * row.facing_lx.value_or(0.0));
}

// u95, in lux, of what the fit holds at a row.
double UnsureAt(const FittedLight& lamp, const ResidualRow& row, const Reading& reading) {
  const double own = kZ95 * row.sigma_relative * row.predicted_lx;
  if (!lamp.distribution || lamp.distribution->pattern_sd.empty()) return own;
  const double there =
      PatternDoubtOf(lamp.distribution->table.grid().vertical_deg, lamp.distribution->pattern_sd)
          .At(std::abs(reading.off_axis.value()));
  return std::hypot(own, kZ95 * there * row.facing_lx.value_or(row.predicted_lx));
}

// Lights that stand for no lamp by name stand for all: photometric files of any make.
void FreeForeignNames(const Session& session, std::vector<EngineLight>& lights) {
  for (EngineLight& light : lights) {
    if (!light.placed && FindLight(session, light.name) == nullptr) light.name.clear();
  }
}

bool StandsFor(const EngineLight& light, const FittedLight& lamp) {
  if (light.name.empty()) return !light.placed || lamp.kind == LightKind::kDome;
  return light.name == lamp.name;
}

// A photometric file is of one lamp, and says nothing of the others.
bool IsOfAnother(const std::vector<EngineLight>& lights, const FittedLight& lamp) {
  return !lights.empty() && std::ranges::all_of(lights, [&](const EngineLight& light) {
    return !light.placed && !light.name.empty() && light.name != lamp.name;
  });
}

struct SquareMean {
  double sum = 0.0;
  int count = 0;

  void Add(const std::optional<double>& value) {
    if (!value) return;
    sum += *value * *value;
    ++count;
  }
  [[nodiscard]] std::optional<double> Root() const {
    return count > 0 ? std::optional(std::sqrt(sum / count)) : std::nullopt;
  }
};

}  // namespace

std::optional<double> ComparedReading::Error() const {
  const double shown = measured_lx + walls_lx;
  if (!(shown > 0.0)) return std::nullopt;
  return (predicted_lx - measured_lx) / shown;
}

std::optional<double> ComparedReading::Judged() const {
  const double shown = measured_lx + walls_lx;
  if (!(shown > 0.0)) return std::nullopt;
  const double off = predicted_lx - measured_lx;
  const double beyond = std::max(0.0, std::abs(off) - left_lx);
  return std::copysign(beyond / std::max(shown, unsure_lx), off);
}

std::vector<std::string> LampsMissing(const Session& session, const LightFile& lamps,
                                      std::vector<EngineLight> lights) {
  FreeForeignNames(session, lights);
  std::vector<std::string> missing;
  for (const FittedLight& lamp : lamps.lights) {
    if (IsOfAnother(lights, lamp)) continue;
    const bool there = std::ranges::any_of(
        lights, [&](const EngineLight& light) { return StandsFor(light, lamp); });
    if (!there) missing.push_back(lamp.name);
  }
  return missing;
}

std::vector<std::string> LightsBeyond(const Session& session,
                                      const std::vector<EngineLight>& lights) {
  std::vector<std::string> beyond;
  for (const EngineLight& light : lights) {
    if (!light.placed || light.name.empty()) continue;
    if (FindLight(session, light.name) == nullptr) beyond.push_back(light.name);
  }
  return beyond;
}

Warnings OldBlenderSpheres(const Session& session, const LightFile& lamps) {
  Warnings warnings;
  for (const FittedLight& lamp : lamps.lights) {
    const LightDescription* description = FindLight(session, lamp.name);
    if (lamp.kind != LightKind::kSphere || !lamp.diameter_m || description == nullptr) continue;
    const MeteredLamp metered = MeteredLampOf(*description, lamp);
    double nearest_m = 1e300;
    for (const Reading* reading : ReadingsOf(session, lamp.name)) {
      nearest_m =
          std::min(nearest_m, reading->position_m ? Length(*reading->position_m - metered.place_m)
                              : reading->distance ? reading->distance->value() + metered.surface_m
                                                  : 1e300);
    }
    const double lack = LackOfOldBlenderSphere(*lamp.diameter_m / 2.0, nearest_m);
    if (!(lack > kLeastLackTold)) continue;
    warnings.push_back({"near_field", lamp.name,
                        std::string(kOldBlenderSphere) + ": " + RoundedText(100.0 * lack, 2) +
                            " % lower than this at " + RoundedText(nearest_m, 3) +
                            " m from its centre, the nearest reading"});
  }
  return warnings;
}

std::vector<ComparedReading> CompareWithReadings(const Session& session, const LightFile& lamps,
                                                 std::vector<EngineLight> lights,
                                                 const WallPart& walls_of) {
  FreeForeignNames(session, lights);
  std::vector<ComparedReading> rows;
  for (const FittedLight& lamp : lamps.lights) {
    if (IsOfAnother(lights, lamp)) continue;
    const auto readings = ReadingsOf(session, lamp.name);
    const LightDescription* description = FindLight(session, lamp.name);
    for (const ResidualRow& row : lamp.residuals) {
      if (description == nullptr || row.index < 0 ||
          static_cast<std::size_t>(row.index) >= readings.size()) {
        continue;
      }
      const Reading& reading = *readings[static_cast<std::size_t>(row.index)];
      const double others = lamp.ambient_lx ? lamp.ambient_lx->value : 0.0;
      const double walls = walls_of(lamp, row);
      rows.push_back({lamp.name, row.index, row.distance_m, row.measured_lx - others - walls, walls,
                      Predicted(lights, MeteredLampOf(*description, lamp), reading), row.used,
                      DegreesFromRadians(reading.off_axis), LeftAt(row),
                      UnsureAt(lamp, row, reading)});
    }
  }
  return rows;
}

std::optional<double> RmsOf(const std::vector<ComparedReading>& rows) {
  SquareMean mean;
  for (const ComparedReading& row : rows) {
    if (row.used) mean.Add(row.Error());
  }
  return mean.Root();
}

std::vector<LampRms> RmsByLamp(const std::vector<ComparedReading>& rows) {
  std::vector<LampRms> lamps;
  for (const ComparedReading& first : rows) {
    if (std::ranges::find(lamps, first.light, &LampRms::light) != lamps.end()) continue;
    SquareMean mean;
    for (const ComparedReading& row : rows) {
      if (row.used && row.light == first.light) mean.Add(row.Judged());
    }
    if (const auto rms = mean.Root()) lamps.push_back({first.light, *rms});
  }
  return lamps;
}

std::optional<double> WorstRms(const std::vector<ComparedReading>& rows) {
  const std::vector<LampRms> lamps = RmsByLamp(rows);
  if (lamps.empty()) return std::nullopt;
  return std::ranges::max(lamps, {}, &LampRms::rms).rms;
}

}  // namespace lightcal
