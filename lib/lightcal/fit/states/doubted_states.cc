// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/doubted_states.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal::fit {
namespace {

struct Step {
  std::size_t index = 0;  // in FittedLight::states
  double dimmer = 0.0;
  double ln = 0.0, sd = 0.0;  // of its light over the reference's, its own scatter
};
using Steps = std::vector<Step>;  // by dimmer, ascending

// The states that differ in the dimmer alone, together.
std::vector<Steps> AlongTheDimmer(const FittedLight& light) {
  std::vector<std::pair<FixtureState, Steps>> groups;
  for (std::size_t i = 0; i < light.states.size(); ++i) {
    const MeasuredState& one = light.states[i];
    const auto dimmer = NumberOfControl(one.state, kDimmerControl);
    if (!dimmer || !(one.relative.value > 0.0)) continue;
    const FixtureState rest = WithoutDimmer(one.state);
    auto group = std::ranges::find_if(
        groups, [&](const auto& known) { return SameState(known.first, rest); });
    if (group == groups.end()) group = groups.insert(groups.end(), {rest, {}});
    group->second.push_back({i, *dimmer, std::log(one.relative.value), one.repeatability});
  }
  std::vector<Steps> out;
  for (auto& [rest, steps] : groups) {
    std::ranges::sort(steps, {}, &Step::dimmer);
    out.push_back(std::move(steps));
  }
  return out;
}

// By how much ln of the lower step's light is above the higher one's beyond doubt; 0 where not.
double Excess(const Step& lower, const Step& higher) {
  constexpr double kSigmas = 5.0, kLeast = 0.1;
  const double more = lower.ln - higher.ln;
  return more > std::max(kLeast, kSigmas * std::hypot(lower.sd, higher.sd)) ? more : 0.0;
}

double WorstExcess(const Steps& steps) {
  double worst = 0.0;
  for (std::size_t j = 1; j < steps.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) worst = std::max(worst, Excess(steps[i], steps[j]));
  }
  return worst;
}

Steps Without(Steps steps, std::size_t at) {
  steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(at));
  return steps;
}

// The step without which the others are in order; of several the one a power of ten mends, then the
// farthest out. Absent: none alone.
std::optional<std::size_t> OneToBlame(const Steps& steps) {
  std::optional<std::size_t> blamed;
  double farthest = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (WorstExcess(Without(steps, i)) > 0.0) continue;
    double out = 0.0;
    for (std::size_t j = 0; j < steps.size(); ++j) {
      out += j < i ? Excess(steps[j], steps[i]) : Excess(steps[i], steps[j]);
    }
    if (out > farthest) blamed = i, farthest = out;
  }
  return blamed;
}

// 10 where the step would be in order were it ten times darker, 1/10 brighter; none where no power
// of ten brings it between its neighbours, or beyond an end within a factor of ten.
std::optional<double> HealingFactor(const Steps& steps, std::size_t at) {
  constexpr double kSlack = 0.05;
  double low = -HUGE_VAL, high = HUGE_VAL;
  for (std::size_t j = 0; j < steps.size(); ++j) {
    if (j < at) low = std::max(low, steps[j].ln);
    if (j > at) high = std::min(high, steps[j].ln);
  }
  if (at == 0) low = high - std::numbers::ln10;
  if (at + 1 == steps.size()) high = low + std::numbers::ln10;
  for (const int power : {1, -1, 2, -2, 3, -3}) {
    const double ln = steps[at].ln - power * std::numbers::ln10;
    if (ln > low - kSlack && ln < high + kSlack) return std::pow(10.0, power);
  }
  return std::nullopt;
}

std::string TenTimes(const std::optional<double>& factor) {
  if (!factor) return "";
  const bool large = *factor > 1.0;
  return " Is it " + ShortestText(std::round(large ? *factor : 1.0 / *factor)) + " times too " +
         (large ? "large" : "small") + "?";
}

constexpr const char* kWhatToDo =
    " Look at its readings, take the wrong one back and read it again";

std::string SharesText(const FittedLight& light, const Step& step) {
  return RoundedText(100.0 * light.states[step.index].relative.value, 3) + " %";
}

void WarnOfOrder(const FittedLight& light, const Steps& steps, Warnings& warnings) {
  const auto blamed = OneToBlame(steps);
  // The worst pair, for the words.
  std::size_t lower = 0, higher = 0;
  double worst = 0.0;
  for (std::size_t j = 1; j < steps.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const bool of_it = !blamed || *blamed == i || *blamed == j;
      const double excess = Excess(steps[i], steps[j]);
      if (of_it && excess > worst) lower = i, higher = j, worst = excess;
    }
  }
  const FixtureState& state = light.states[steps[blamed.value_or(lower)].index].state;
  const auto text = [&](std::size_t i) {
    return StateText(light.states[steps[i].index].state) + " at " + SharesText(light, steps[i]);
  };
  warnings.push_back({"state_not_monotonic", light.name + " at " + StateText(state),
                      "of " + StateText(light.state) + " " + text(lower) + " was read, and " +
                          text(higher) + ": no dimmer gives more where it is set lower." +
                          (blamed ? TenTimes(HealingFactor(steps, *blamed)) : "") + kWhatToDo});
}

// Of one that is in order: whether the others say something far from it.
void WarnOfFar(const FittedLight& light, const Steps& steps, std::size_t at, Warnings& warnings) {
  const double ln_far = std::log(4.0);
  const Step &below = steps[at - 1], &here = steps[at], &above = steps[at + 1];
  // What the costly question is asked of.
  const auto between = LnBetween({below.dimmer, below.ln}, {above.dimmer, above.ln}, here.dimmer);
  if (!between) return;
  const auto [low, high] = *between;
  if (here.ln > low - ln_far && here.ln < high + ln_far) return;
  const auto told = AnswerWithout(light, here.index);
  if (!told || !(told->relative.value > 0.0)) return;
  const double off = here.ln - std::log(told->relative.value);
  const double half = std::log1p(told->relative.u95 / told->relative.value);
  if (std::abs(off) < std::max(ln_far, 2.0 * half)) return;
  warnings.push_back(
      {"state_out_of_line", light.name + " at " + StateText(light.states[here.index].state),
       "was read at " + SharesText(light, here) + " of " + StateText(light.state) +
           ", where the states beside it say " + RoundedText(100.0 * told->relative.value, 2) +
           " %" + TenTimes(HealingFactor(steps, at)) + "." + kWhatToDo});
}

}  // namespace

std::optional<LnRange> LnBetween(const DimmedLight& below, const DimmedLight& above,
                                 double dimmer) {
  if (!(below.dimmer > 0.0) || !(above.dimmer > below.dimmer)) return std::nullopt;
  const double of_ratio = std::log(dimmer / below.dimmer) / std::log(above.dimmer / below.dimmer);
  const double of_step = (dimmer - below.dimmer) / (above.dimmer - below.dimmer);
  const auto along = [&](double part) { return below.ln + part * (above.ln - below.ln); };
  return LnRange{std::min(along(of_ratio), along(of_step)),
                 std::max(along(of_ratio), along(of_step))};
}

void WarnOfDoubtedStates(const FittedLight& light, Warnings& warnings) {
  for (const Steps& steps : AlongTheDimmer(light)) {
    if (WorstExcess(steps) > 0.0) {
      WarnOfOrder(light, steps, warnings);
      continue;
    }
    for (std::size_t i = 1; i + 1 < steps.size(); ++i) WarnOfFar(light, steps, i, warnings);
  }
}

}  // namespace lightcal::fit
