// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/fit/states/ln_of.h"

namespace lightcal::fit {
namespace {

constexpr double kSamePlaces_m = 0.005;

bool OtherPlace(const Reading& a, const Reading& b) {
  if (a.position_m && b.position_m) return Length(*a.position_m - *b.position_m) > kSamePlaces_m;
  if (a.distance && b.distance) {
    return std::abs(a.distance->value() - b.distance->value()) > kSamePlaces_m;
  }
  return false;
}

bool TellsOffset(const Session& part, const std::string& light) {
  const Reading* first = nullptr;
  for (const SessionReading& row : part.readings) {
    const Reading& reading = row.reading;
    const bool lit = reading.light == light && reading.lamp == LampState::kOn &&
                     reading.illuminance && !reading.shadow_card;
    if (!lit) continue;
    if (first == nullptr) first = &reading;
    if (OtherPlace(*first, reading)) return true;
  }
  return false;
}

Session WithoutReadings(const Session& session) {
  Session out = session;
  out.readings.clear();
  out.state_readings.clear();
  return out;
}

double MeterSd(const FittedLight& a, const FittedLight& b) {
  if (!a.meter || !b.meter || a.meter->name != b.meter->name) return 0.0;
  return std::min(a.meter->calibration_relative, b.meter->calibration_relative);
}

}  // namespace

bool SameGeometry(const FixtureState& a, const FixtureState& b) {
  return std::ranges::all_of(a, [&](const ControlValue& control) {
    const ControlValue* other = FindControl(b, control.name);
    if (other == nullptr) return false;
    if (control.IsWord()) return control.word == other->word;
    return control.name != kZoomControl || control.number == other->number;
  });
}

GeometryParts SplitGeometries(const Session& session, const LightDescription& light) {
  GeometryParts parts;
  const FixtureState reference = ReferenceState(session, light.name);
  const auto own = [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    return reading.light == light.name && reading.lamp == LampState::kOn && !reading.state.empty();
  };
  std::vector<FixtureState> geometries;
  for (const SessionReading& row : session.state_readings) {
    if (!own(row) || SameGeometry(row.reading.state, reference)) continue;
    const auto known = [&](const FixtureState& one) {
      return SameGeometry(one, row.reading.state);
    };
    if (std::ranges::none_of(geometries, known)) geometries.push_back(row.reading.state);
  }
  std::vector<FixtureState> told;
  for (const FixtureState& geometry : geometries) {
    Session part = WithoutReadings(session);
    for (const auto* const rows : {&session.readings, &session.state_readings}) {
      for (const SessionReading& row : *rows) {
        const bool lit = own(row);
        const bool here = lit ? SameGeometry(row.reading.state, geometry)
                              : row.reading.light == light.name;  // its lamp off
        if (here) part.readings.push_back(row);
      }
    }
    if (!SplitStates(part) || !TellsOffset(part, light.name)) continue;
    told.push_back(geometry);
    parts.others.push_back(std::move(part));
  }
  if (parts.others.empty()) return parts;
  parts.main = session;
  std::erase_if(parts.main.state_readings, [&](const SessionReading& row) {
    return own(row) && std::ranges::any_of(told, [&](const FixtureState& one) {
             return SameGeometry(one, row.reading.state);
           });
  });
  return parts;
}

void TakeGeometry(const FittedLight& own, FittedLight& light) {
  if (!own.intensity_cd || !light.intensity_cd || !(light.intensity_cd->value > 0.0)) return;
  const double ln = std::log(own.intensity_cd->value / light.intensity_cd->value);
  const double meter = MeterSd(own, light);
  const double between =
      std::max(0.0, std::pow(SdOfLn(*own.intensity_cd), 2.0) +
                        std::pow(SdOfLn(*light.intensity_cd), 2.0) - 2.0 * meter * meter);
  for (const MeasuredState& one : own.states) {
    MeasuredState state = one;
    const double within = SdOfLn(one.relative);
    state.relative =
        UncertainFromLog(ln + std::log(one.relative.value), std::hypot(std::sqrt(between), within));
    light.states.push_back(std::move(state));
  }
}

}  // namespace lightcal::fit
