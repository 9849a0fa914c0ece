// SPDX-License-Identifier: Apache-2.0
// Readings that name every lit lamp -> one row a light.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include "lightcal/records/session.h"

namespace lightcal {
namespace {

constexpr double kSamePlaceMetres = 0.005;
constexpr double kSameDistanceRelative = 1e-3;

using Distances = std::vector<std::pair<std::string, Metres>>;

// A place where readings were taken: what any of them says of it.
struct Place {
  std::optional<Vec3> position_m;
  std::optional<Vec3> normal;  // a meter turned otherwise stands elsewhere
  Distances distances;
};

std::optional<Metres> Find(const Distances& distances, const std::string& light) {
  const auto found = std::ranges::find(distances, light, &std::pair<std::string, Metres>::first);
  if (found == distances.end()) return std::nullopt;
  return found->second;
}

bool Says(const LitReading& reading) {
  return reading.reading.position_m || !reading.distances.empty();
}

bool IsTurned(const std::optional<Vec3>& a, const std::optional<Vec3>& b) {
  constexpr double kSameAngle_rad = 1e-3;
  return a && b && Dot(*a, *b) < std::cos(kSameAngle_rad) * Length(*a) * Length(*b);
}

bool StandsAt(const LitReading& reading, const Place& place) {
  if (reading.reading.position_m) {
    return place.position_m && !IsTurned(reading.reading.normal, place.normal) &&
           Length(*reading.reading.position_m - *place.position_m) < kSamePlaceMetres;
  }
  bool shared = false;
  for (const auto& [light, distance] : reading.distances) {
    const auto there = Find(place.distances, light);
    if (!there) continue;
    const double apart = std::abs(there->value() - distance.value());
    if (apart > kSameDistanceRelative * distance.value()) return false;
    shared = true;
  }
  return shared;
}

bool FallsWithDistance(LightKind kind) {
  return kind != LightKind::kDirectional && kind != LightKind::kDome;
}

class Places {
 public:
  explicit Places(const std::vector<LitReading>& readings) {
    for (const LitReading& reading : readings) {
      if (Says(reading)) Note(reading);
    }
  }
  // Whether any reading says where it was taken.
  [[nodiscard]] bool Told() const { return !places_.empty(); }
  // -1 where nothing says; the only place of all where no reading says any.
  [[nodiscard]] int Of(const LitReading& reading) const {
    if (places_.empty()) return 0;
    const auto place = std::ranges::find_if(
        places_, [&](const Place& at) { return Says(reading) && StandsAt(reading, at); });
    return place == places_.end() ? -1 : static_cast<int>(place - places_.begin());
  }
  [[nodiscard]] std::optional<Metres> Distance(int place, const std::string& light) const {
    if (place < 0 || places_.empty()) return std::nullopt;
    return Find(places_[static_cast<std::size_t>(place)].distances, light);
  }

 private:
  void Note(const LitReading& reading) {
    auto place =
        std::ranges::find_if(places_, [&](const Place& at) { return StandsAt(reading, at); });
    if (place == places_.end()) place = places_.insert(place, Place{});
    if (reading.reading.position_m) {
      place->position_m = reading.reading.position_m;
      place->normal = reading.reading.normal;
    }
    for (const auto& [light, distance] : reading.distances) {
      if (!Find(place->distances, light)) place->distances.emplace_back(light, distance);
    }
  }

  std::vector<Place> places_;
};

}  // namespace

namespace {

// A meter's reading of one light facing it is one with that lamp alone lit: lit = [its name].
// Absent of any that has a card, a tilt, an angle or a state of its own.
std::optional<LitReading> AsLit(const SessionReading& row) {
  const Reading& reading = row.reading;
  const bool facing = reading.tilt.value() == 0.0 && reading.off_axis.value() == 0.0;
  const bool by_meter = reading.meter != kDataSheetMeter && !ByOwnScale(reading);
  if (!IsLit(reading) || !facing || !by_meter || !reading.state.empty() || !row.fault.empty()) {
    return std::nullopt;
  }
  LitReading out{reading, row.where, {reading.light}, {}};
  if (reading.distance) out.distances.emplace_back(reading.light, *reading.distance);
  return out;
}

// What the readings of one light say of the others: nothing of theirs was in it.
void SpreadOwnReadings(const Places& places, Session& session) {
  std::vector<SessionReading> out;
  for (const SessionReading& own : session.readings) {
    const std::optional<LitReading> reading = AsLit(own);
    const int place = reading && Says(*reading) ? places.Of(*reading) : -1;
    if (place < 0) continue;
    for (const LightDescription& light : session.lights) {
      if (light.name == own.reading.light) continue;
      SessionReading row{own.reading, own.where, reading->lit, place};
      row.reading.light = light.name;
      row.reading.lamp = LampState::kOff;
      row.reading.distance = places.Distance(place, light.name);
      out.push_back(std::move(row));
    }
  }
  std::ranges::move(out, std::back_inserter(session.readings));
}

}  // namespace

void SpreadLitReadings(Session& session) {
  const Places places(session.lit_readings);
  if (places.Told()) SpreadOwnReadings(places, session);
  for (const LitReading& reading : session.lit_readings) {
    const int place = places.Of(reading);
    std::vector<std::string> lit = reading.lit;
    std::ranges::sort(lit);
    lit.erase(std::unique(lit.begin(), lit.end()), lit.end());
    for (const LightDescription& light : session.lights) {
      SessionReading row{reading.reading, reading.where, lit, place};
      row.reading.light = light.name;
      const auto own = std::erase(row.others_lit, light.name);
      row.reading.lamp = own > 0 ? LampState::kOn : LampState::kOff;
      row.reading.distance = places.Distance(place, light.name);
      // Nobody said how far this lamp was: a reading of the others.
      const bool nowhere = !row.reading.distance && !row.reading.position_m;
      if (own > 0 && nowhere && Says(reading) && FallsWithDistance(light.kind)) continue;
      session.readings.push_back(std::move(row));
    }
  }
}

}  // namespace lightcal
