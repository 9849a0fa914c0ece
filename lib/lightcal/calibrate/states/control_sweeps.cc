// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/control_sweeps.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "lightcal/fit/states/state_answer.h"

namespace lightcal {
namespace {

constexpr int kSweepPlaces = 41;

bool AlikeBut(const FixtureState& a, const FixtureState& b, const std::string& control) {
  FixtureState one = a;
  FixtureState other = b;
  const auto named = [&](const ControlValue& value) { return value.name == control; };
  std::erase_if(one, named);
  std::erase_if(other, named);
  return SameState(one, other);
}

FixtureState With(FixtureState state, const std::string& control, double number) {
  for (ControlValue& value : state) {
    if (value.name == control) value.number = number;
  }
  return state;
}

std::optional<ControlSweep::Point> SweepPointAt(StateAnswers& answers, const FixtureState& state,
                                                const std::string& control) {
  const auto answer = answers.At(state);
  if (!answer) return std::nullopt;
  ControlSweep::Point point;
  point.at = NumberOfControl(state, control).value_or(0.0);
  point.relative = answer->relative;
  point.cct_K = answer->color.cct_K;
  point.xy = answer->color.xy;
  point.promised_cct_K = answer->promised_cct_K;
  return point;
}

}  // namespace

std::vector<ControlSweep> ControlSweepsOf(const FittedLight& light) {
  std::vector<ControlSweep> sweeps;
  if (light.states.empty()) return sweeps;
  const FixtureState& reference = light.states.front().state;
  StateAnswers answers(light);
  for (const ControlValue& control : reference) {
    if (control.IsWord()) continue;
    ControlSweep sweep;
    sweep.light = light.name;
    sweep.control = control.name;
    sweep.reference = control.number;
    FixtureState others = reference;
    std::erase_if(others, [&](const ControlValue& value) { return value.name == control.name; });
    sweep.others = StateText(others);
    std::vector<double> labels;
    for (const MeasuredState& state : light.states) {
      if (!AlikeBut(state.state, reference, control.name)) continue;
      if (auto point = SweepPointAt(answers, state.state, control.name)) {
        labels.push_back(point->at);
        sweep.read.push_back(*std::move(point));
      }
    }
    if (sweep.read.size() < 2) continue;
    const auto [least, most] = std::ranges::minmax(labels);
    if (!(most > least)) continue;
    for (int i = 0; i < kSweepPlaces; ++i) {
      labels.push_back(least + (most - least) * i / (kSweepPlaces - 1));
    }
    std::ranges::sort(labels);
    const auto repeated = std::ranges::unique(labels);
    labels.erase(repeated.begin(), repeated.end());
    for (const double label : labels) {
      const FixtureState at = With(reference, control.name, label);
      if (auto point = SweepPointAt(answers, at, control.name)) {
        sweep.curve.push_back(*std::move(point));
      }
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

std::vector<ControlSweep> ControlSweepsOf(const LightFile& file) {
  std::vector<ControlSweep> sweeps;
  for (const FittedLight& light : file.lights) {
    std::ranges::move(ControlSweepsOf(light), std::back_inserter(sweeps));
  }
  return sweeps;
}

}  // namespace lightcal
