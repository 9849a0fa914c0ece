// SPDX-License-Identifier: Apache-2.0
#include "guide/sweep_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>
#include <utility>

namespace lightcal::app {
namespace {

constexpr std::size_t kMostStates = 10000;

Result<std::vector<ControlValue>> ValuesOf(const std::string& text) {
  const std::size_t equals = text.find('=');
  std::vector<ControlValue> values;
  std::string_view rest = std::string_view(text).substr(std::min(text.size(), equals + 1));
  while (equals != std::string::npos && !rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    values.push_back(ParseControl(text.substr(0, equals), rest.substr(0, comma)));
    rest.remove_prefix(std::min(rest.size(), comma + 1));
  }
  for (const ControlValue& value : values) {
    if (const std::string fault = FaultOfState({value}); !fault.empty()) {
      return WrongUsage("--over " + text, fault);
    }
  }
  if (values.empty()) {
    return WrongUsage("--over " + text, "write a control and its values: dimmer=100,50,25,12");
  }
  return values;
}

// The same on every computer: no distribution of <random> is.
void Shuffle(std::vector<FixtureState>& states, std::uint64_t by) {
  std::uint64_t seed = 1469598103934665603ULL ^ (by - 1);  // FNV-1a
  for (const FixtureState& state : states) {
    for (const char c : StateText(state)) {
      seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
  }
  std::mt19937_64 random(seed);
  for (std::size_t i = states.size(); i > 1; --i) std::swap(states[i - 1], states[random() % i]);
}

}  // namespace

Result<std::vector<FixtureState>> StatesOver(const std::vector<std::string>& over) {
  std::vector<FixtureState> states = {FixtureState{}};
  for (const std::string& text : over) {
    const auto values = ValuesOf(text);
    if (!values) return tl::unexpected(values.error());
    if (states.size() * values->size() > kMostStates) {
      return WrongUsage("--over", "these are more than 10000 states; give fewer values");
    }
    std::vector<FixtureState> more;
    for (const FixtureState& state : states) {
      for (const ControlValue& value : *values) {
        more.push_back(state);
        more.back().push_back(value);
        SortState(more.back());
      }
    }
    states = std::move(more);
  }
  std::vector<FixtureState> unique;
  for (FixtureState& state : states) {
    if (const std::string fault = FaultOfState(state); !fault.empty()) {
      return WrongUsage("--over", fault);
    }
    const auto same = [&](const FixtureState& other) { return SameState(other, state); };
    if (std::ranges::none_of(unique, same)) unique.push_back(std::move(state));
  }
  return unique;
}

FixtureState FullOf(const std::vector<FixtureState>& states) {
  const auto dimmer = [](const FixtureState& state) {
    return NumberOfControl(state, kDimmerControl).value_or(0.0);
  };
  return *std::ranges::max_element(states, {}, dimmer);
}

std::vector<FixtureState> SweepOrder(const std::vector<FixtureState>& states,
                                     std::optional<std::uint64_t> seed) {
  const FixtureState full = FullOf(states);
  std::vector<FixtureState> others;
  for (const FixtureState& state : states) {
    if (!SameState(state, full)) others.push_back(state);
  }
  if (seed) Shuffle(others, *seed);
  std::vector<FixtureState> order = {full};
  for (std::size_t i = 0; i < others.size(); ++i) {
    order.push_back(others[i]);
    if ((i + 1) % kBackToFull == 0 || i + 1 == others.size()) order.push_back(full);
  }
  return order;
}

std::vector<FixtureState> NotYetRead(const std::vector<FixtureState>& order, const Session& session,
                                     const Reading& frame) {
  std::vector<FixtureState> held;
  VisitReadings(session, [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    const bool lit = reading.lamp == LampState::kOn && !reading.shadow_card;
    const bool here =
        !frame.distance ||
        (reading.distance && std::abs(reading.distance->value() - frame.distance->value()) < 1e-6);
    if (reading.light == frame.light && lit && here && !reading.state.empty()) {
      held.push_back(reading.state);
    }
  });
  std::vector<FixtureState> left;
  for (const FixtureState& state : order) {
    const auto done = std::ranges::find_if(
        held, [&](const FixtureState& other) { return SameState(other, state); });
    if (done == held.end()) {
      left.push_back(state);
    } else {
      held.erase(done);
    }
  }
  return left;
}

std::vector<FixtureState> EndsOf(const std::vector<FixtureState>& states) {
  const FixtureState full = FullOf(states);
  std::vector<FixtureState> ends = {full};
  for (const ControlValue& control : full) {
    if (control.IsWord()) continue;
    ControlValue least = control;
    ControlValue most = control;
    for (const FixtureState& state : states) {
      const double number = NumberOfControl(state, control.name).value_or(control.number);
      least.number = std::min(least.number, number);
      most.number = std::max(most.number, number);
    }
    for (const ControlValue& end : {most, least}) {
      FixtureState state = full;
      *std::ranges::find(state, control.name, &ControlValue::name) = end;
      const auto same = [&](const FixtureState& other) { return SameState(other, state); };
      if (std::ranges::none_of(ends, same)) ends.push_back(state);
    }
  }
  return ends;
}

}  // namespace lightcal::app
