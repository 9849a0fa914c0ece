// SPDX-License-Identifier: Apache-2.0
// A lamp as a function of its labels, for searches.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lightcal/calibrate/states/match_states.h"
#include "lightcal/fit/states/state_answer.h"

namespace lightcal {

// What it is at any setting, and where a search may begin. The lamp's light must outlive it; for
// one thread at a time.
class LampSettings {
 public:
  explicit LampSettings(const SettableLamp& lamp);

  // Absent where the lamp does not answer, or has no colour there.
  [[nodiscard]] std::optional<LampSetting> At(const FixtureState& state) const;
  // The states that were read, the reference first; of a lamp without states its full dimmer.
  [[nodiscard]] const std::vector<LampSetting>& read() const { return read_; }
  // Those, and a grid between them.
  [[nodiscard]] const std::vector<LampSetting>& candidates() const { return candidates_; }

  // The numbers that a search may move in a state: where in it they stand, and how far they go.
  struct Axis {
    std::size_t control = 0;
    double least = 0.0, most = 0.0, step = 0.0;  // step: what a dial shows
  };
  [[nodiscard]] std::vector<Axis> AxesAt(const FixtureState& state) const;

 private:
  [[nodiscard]] std::optional<LampSetting> AnsweredBy(StateAnswers& answers,
                                                      const FixtureState& state) const;
  void AddGrid(const FixtureState& like);

  SettableLamp lamp_;
  std::unique_ptr<StateAnswers> answers_;  // of a lamp with states
  std::vector<LampSetting> read_, candidates_;
};

using Lamps = std::vector<const LampSettings*>;
using Settings = std::vector<LampSetting>;  // one a lamp

// Distance of two colours in CIE 1976 u'v'.
[[nodiscard]] double UvBetween(Xy a, Xy b);
// All lamps together, without their errors; of one without a level its colour.
[[nodiscard]] LightPoint SumOf(const Settings& settings);
// log2 of its level over the target's; absent where they are not of one kind.
[[nodiscard]] std::optional<double> StopsOver(const LightPoint& point, const LightPoint& target);

}  // namespace lightcal
