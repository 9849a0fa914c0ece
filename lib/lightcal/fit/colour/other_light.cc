// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/other_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/row_values.h"
#include "lightcal/fit/plan/scene_of_session.h"
#include "lightcal/fit/states/ln_of.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal::fit {
namespace {

constexpr double kUnknownPlace = 1.0;  // 1 sigma of the walls' share where nobody said how far
constexpr double kCardLux = 0.02;      // of a share that two readings of one meter tell
constexpr double kUnknownPlace_m = 1.0;

// Not what the box says: a temperature of no named instrument.
bool MeasuresColor(const Reading& reading) {
  return reading.xy || reading.color_source != ColorSource::kUnknown;
}

// What may shine besides where nobody read it, lux: the root mean square of what the gate allows
// it (light/effects/ambient.h).
double UnreadAmbient(const Session& session, const LightDescription& description,
                     const FittedLight& light) {
  const auto effect = std::ranges::find(light.effects, "ambient", &EffectReport::name);
  if (effect == light.effects.end() || effect->state != EffectState::kOn) return 0.0;
  double dimmest = std::numeric_limits<double>::infinity();
  for (const SessionReading& row : session.readings) {
    if (row.reading.light != description.name || !IsLit(row.reading)) continue;
    dimmest = std::min(dimmest, row.reading.illuminance->value());
  }
  return std::isfinite(dimmest) ? effect->bound / std::numbers::sqrt3 * dimmest : 0.0;
}

double MeanScatter(const std::vector<LampInRoom>& in_room) {
  double square = 0.0;
  for (const LampInRoom& one : in_room) square += one.weight * one.scatter * one.scatter;
  return std::sqrt(square);
}

// ln E_walls of a located lamp, and its variance but for the scatter.
std::pair<double, double> LnWalls(const LocatedLamp& lamp, double distance_m) {
  constexpr int n = LocatedLamp::kCount;
  constexpr int kLnB = 5, kSlope = 6;
  const double x = std::log(distance_m / kWallReference_m);
  const WallsFound& walls = *lamp.walls;
  const double ln = lamp.ln_intensity + walls.ln_b + walls.slope * x + walls.bend * x * x;
  double variance = 0.0;
  const std::array<std::pair<int, double>, 3> gradient = {{{0, 1.0}, {kLnB, 1.0}, {kSlope, x}}};
  for (const auto& [i, a] : gradient) {
    for (const auto& [j, b] : gradient) variance += a * b * lamp.covariance[i * n + j];
  }
  return {ln, std::max(0.0, variance)};
}

}  // namespace

OtherLight::OtherLight(const Session& session, const LightDescription& description,
                       const FittedLight& light)
    : session_(session), description_(description), light_(light) {
  ambient_lx_ = std::max(light.ambient_lx ? light.ambient_lx->value : 0.0,
                         UnreadAmbient(session, description, light));
  for (const auto* rows : {&session.readings, &session.state_readings}) {
    for (const SessionReading& row : *rows) {
      if (row.reading.light == description.name && row.others_lit.empty()) Note(row);
    }
  }
  NoteUnknownPlace();
}

void OtherLight::Note(const SessionReading& row) {
  const Reading& reading = row.reading;
  if (reading.shadow_card) {
    cards_.push_back(&row);
    return;
  }
  if (reading.lamp == LampState::kOff && reading.illuminance) offs_.push_back(&row);
  if (!MeasuresColor(reading) || reading.lamp == LampState::kOff) return;
  const auto distance = DistanceOf(reading);
  if (!distance) of_unknown_place_.common = kUnknownPlace;
  if (!distance || walls_.contains(*distance)) return;
  if (const auto there = WallsAt(*distance)) walls_.emplace(*distance, *there);
}

// Of one light everywhere what the fit found; of light that differs, what was read there with the
// lamp off.
double OtherLight::AmbientIn(const Reading& reading) const {
  if (light_.ambient_lx) return ambient_lx_;
  double sum = 0.0;
  int count = 0;
  for (const SessionReading* off : offs_) {
    if (!SamePlace(off->reading, reading)) continue;
    sum += off->reading.illuminance->value();
    ++count;
  }
  return count > 0 ? sum / count : ambient_lx_;
}

// Where its colours were read elsewhere, else at a metre.
void OtherLight::NoteUnknownPlace() {
  if (!(of_unknown_place_.common > 0.0)) return;
  const auto share = [](const Walls& there) {
    return there.walls_lx / (there.walls_lx + std::max(0.0, there.direct_lx));
  };
  for (const auto& [distance, there] : walls_) {
    of_unknown_place_.walls += share(there) / static_cast<double>(walls_.size());
  }
  if (!walls_.empty()) return;
  if (const auto there = WallsAt(kUnknownPlace_m)) of_unknown_place_.walls = share(*there);
}

std::optional<double> OtherLight::DistanceOf(const Reading& reading) const {
  if (reading.distance) return reading.distance->value();
  const std::optional<Vec3>& lamp = light_.position_m;
  if (!reading.position_m || !lamp) return std::nullopt;
  const double distance = Length(*reading.position_m - *lamp);
  return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

std::optional<OtherLight::Walls> OtherLight::WallsAt(double distance_m) const {
  Walls out;
  const auto facing = PredictInRoom(light_, Metres(distance_m), 0.0);
  if (facing && *facing) {
    out.walls_lx = (*facing)->walls_lx.value;
    const double ambient = light_.ambient_lx ? light_.ambient_lx->value : 0.0;
    out.direct_lx = (*facing)->whole_lx.value - out.walls_lx - ambient;
    out.sd_ln = SdOfLn((*facing)->walls_lx);
    out.scatter = MeanScatter(light_.in_room);
    return out;
  }
  if (light_.located && light_.located->walls) {
    const auto [ln, variance] = LnWalls(*light_.located, distance_m);
    out.walls_lx = std::exp(ln);
    out.direct_lx = std::exp(light_.located->ln_intensity) / (distance_m * distance_m);
    out.scatter = light_.located->walls->scatter;
    out.sd_ln = std::hypot(std::sqrt(variance), out.scatter);
    return out;
  }
  const std::optional<WallPrior> prior = OneNormalOf(WallPriorsOf(session_, description_));
  if (!prior) return std::nullopt;
  const double x = std::log(distance_m / kWallReference_m);
  const double candela = light_.intensity_cd ? light_.intensity_cd->value : 1.0;
  out.walls_lx = candela * WallsPerCandela(*prior, distance_m);
  out.direct_lx = candela / (distance_m * distance_m);
  out.scatter = prior->scatter;
  out.sd_ln = std::hypot(prior->sd_ln_b, prior->sd_slope * x, prior->scatter);
  return out;
}

const Reading* OtherLight::CardBeside(const Reading& reading) const {
  const auto beside = std::ranges::find_if(
      cards_, [&](const SessionReading* card) { return IsCardOf(*card, reading); });
  return beside == cards_.end() ? nullptr : &(*beside)->reading;
}

OtherShares OtherLight::Unlit(const Reading& reading) const {
  OtherShares out;
  if (reading.lamp == LampState::kOff) {
    out.ambient = 1.0;
    return out;
  }
  const double lux = reading.illuminance ? reading.illuminance->value() : 0.0;
  out.ambient = lux > 0.0 ? std::min(1.0, AmbientIn(reading) / lux) : 0.0;
  out.walls = 1.0 - out.ambient;
  return out;
}

OtherShares OtherLight::SharesIn(const SessionReading& row) const {
  const Reading& reading = row.reading;
  if (!MeasuresColor(reading) || !row.others_lit.empty()) return {};
  if (reading.meter == kDataSheetMeter) return {};
  // No paint is known of the ground.
  const bool walls_shine = session_.surroundings == Surroundings::kIndoors &&
                           !reading.of_luminance && HoldsWallLight(session_, description_, reading);
  const double ambient_lx = AmbientIn(reading);
  if (!walls_shine && !(ambient_lx > 0.0)) return {};
  if (reading.lamp == LampState::kOff || reading.shadow_card) return Unlit(reading);
  OtherShares out;
  const auto distance = DistanceOf(reading);
  if (!distance) return walls_shine ? of_unknown_place_ : OtherShares{};
  const auto known = walls_.find(*distance);
  if (known == walls_.end()) return {};
  const Walls& there = known->second;
  const double direct =
      std::max(0.0, there.direct_lx) * std::max(0.0, std::cos(reading.tilt.value()));
  const double lux = reading.illuminance ? reading.illuminance->value() : 0.0;
  const double whole = lux > 0.0 ? lux : direct + (walls_shine ? there.walls_lx : 0.0) + ambient_lx;
  if (!(whole > 0.0)) return {};
  out.ambient = std::min(1.0, ambient_lx / whole);
  if (!walls_shine) return out;
  const Reading* card = lux > 0.0 ? CardBeside(reading) : nullptr;
  if (card != nullptr) {
    const double left = std::max(0.0, card->illuminance->value() - ambient_lx);
    out.walls = std::min(left * (1.0 + kCardHides) / lux, 1.0 - out.ambient);
    out.own = std::hypot(kCardHides, kCardLux);
    return out;
  }
  const double lamp = direct + there.walls_lx;
  out.walls = lamp > 0.0 ? (1.0 - out.ambient) * there.walls_lx / lamp : 0.0;
  // d w / w = (1 - w) d ln(walls/direct)
  const double open = lamp > 0.0 ? direct / lamp : 0.0;
  out.own = open * there.scatter;
  out.common =
      open * std::sqrt(std::max(0.0, there.sd_ln * there.sd_ln - there.scatter * there.scatter));
  return out;
}

}  // namespace lightcal::fit
