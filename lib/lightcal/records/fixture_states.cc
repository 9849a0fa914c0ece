// SPDX-License-Identifier: Apache-2.0
// A session's readings by the states of their fixtures.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>
#include <set>
#include <string>
#include <utility>

#include "lightcal/records/session.h"

namespace lightcal {
namespace {

bool LampIsOn(const Reading& reading) { return reading.lamp == LampState::kOn; }

// What was read of one lamp at one state.
struct StateRows {
  const FixtureState* state = nullptr;
  std::set<long long> places{};  // distances in half millimetres, positions by their sum
  double brightest = 0.0;        // E d^2 of its readings, E where no distance is known
};

long long PlaceOf(const Reading& reading) {
  if (reading.distance) return std::llround(2000.0 * reading.distance->value());
  if (!reading.position_m) return 0;
  const Vec3& p = *reading.position_m;
  return std::llround(2000.0 * (p[0] + 31.0 * p[1] + 997.0 * p[2]));
}

double BrightnessOf(const Reading& reading) {
  const double e = reading.illuminance.value_or(Lux(0.0)).value();
  const double d = reading.distance.value_or(Metres(1.0)).value();
  return e * d * d;
}

std::vector<StateRows> StatesOf(const Session& session, std::string_view light) {
  std::vector<StateRows> states;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light || reading.state.empty() || !LampIsOn(reading)) continue;
    auto known = std::ranges::find_if(
        states, [&](const StateRows& one) { return SameState(*one.state, reading.state); });
    if (known == states.end()) known = states.insert(states.end(), StateRows{&reading.state});
    const bool bright = reading.illuminance || !reading.spectrum_file.empty();
    if (!bright || reading.shadow_card) continue;
    known->places.insert(PlaceOf(reading));
    known->brightest = std::max(known->brightest, BrightnessOf(reading));
  }
  return states;
}

// What the box says is said of no state of its controls.
bool OfTheBox(const Reading& reading) {
  return reading.meter == kDataSheetMeter && reading.state.empty();
}

bool SameControls(const FixtureState& a, const FixtureState& b) {
  return std::ranges::equal(a, b, [](const ControlValue& one, const ControlValue& other) {
    return one.name == other.name && one.IsWord() == other.IsWord();
  });
}

Result<void> CheckControls(const Session& session, const std::string& light,
                           const FixtureState& reference) {
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light || !LampIsOn(reading) || OfTheBox(reading)) continue;
    if (reading.state.empty()) {
      return Refused("state_missing", row.where,
                     "other readings of \"" + light +
                         "\" say what its controls stood at and this one does not; give it a "
                         "state, such as state = { " +
                         StateText(reference) + " }");
    }
    if (!SameControls(reading.state, reference)) {
      return Refused("state_controls", row.where,
                     "its state (" + StateText(reading.state) +
                         ") names other controls than another reading of \"" + light + "\" (" +
                         StateText(reference) + "); every reading of one lamp says the same ones");
    }
  }
  return {};
}

}  // namespace

FixtureState ReferenceState(const Session& session, std::string_view light) {
  const std::vector<StateRows> states = StatesOf(session, light);
  if (states.empty()) return {};
  const auto merit = [](const StateRows& one) {
    return std::pair(one.places.size(), NumberOfControl(*one.state, kDimmerControl).value_or(0.0));
  };
  const auto most = std::ranges::max(states | std::views::transform(merit));
  auto best = states | std::views::filter([&](const StateRows& one) { return merit(one) == most; });
  const auto brightest = std::ranges::max(best | std::views::transform(&StateRows::brightest));
  // One a tenth darker may be a single emitter; nearer ones differ by how the meter repeats, too.
  return *std::ranges::find_if(best, [&](const StateRows& one) {
            return one.brightest >= 0.9 * brightest;
          })->state;
}

bool HoldsAt(const StateDescription& one, const FixtureState& state) {
  return std::ranges::all_of(one.state, [&](const ControlValue& control) {
    const ControlValue* there = FindControl(state, control.name);
    return there != nullptr && SameState({control}, {*there});
  });
}

LightDescription DescriptionAt(const LightDescription& light, const FixtureState& state) {
  LightDescription out = light;
  const auto take = [](auto& kept, const auto& given) {
    if (given) kept = *given;
  };
  for (const StateDescription& one : light.at) {
    if (!HoldsAt(one, state)) continue;
    if (one.kind && *one.kind != out.kind) {
      for (auto* size : {&out.diameter, &out.width, &out.height, &out.length, &out.radius}) {
        size->reset();
      }
      out.inner.reset();
      out.outer.reset();
    }
    take(out.kind, one.kind);
    take(out.fixture, one.fixture);
    take(out.diameter, one.diameter);
    take(out.width, one.width);
    take(out.height, one.height);
    take(out.length, one.length);
    take(out.radius, one.radius);
    take(out.inner, one.inner);
    take(out.outer, one.outer);
  }
  return out;
}

Result<void> SplitStates(Session& session) {
  for (const LightDescription& light : session.lights) {
    const FixtureState reference = ReferenceState(session, light.name);
    if (reference.empty()) continue;
    if (auto fits = CheckControls(session, light.name, reference); !fits) return fits;
    std::vector<SessionReading> kept;
    for (SessionReading& row : session.readings) {
      const Reading& reading = row.reading;
      const bool other = reading.light == light.name && LampIsOn(reading) && !OfTheBox(reading) &&
                         !SameState(reading.state, reference);
      (other ? session.state_readings : kept).push_back(std::move(row));
    }
    session.readings = std::move(kept);
  }
  return {};
}

}  // namespace lightcal
