// SPDX-License-Identifier: Apache-2.0
// What a fixture's controls said: dimmer = 50, cct_K = 4000, modifier = "softbox". Labels, not
// light.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// One control: its name, and the number or the word that it stood at.
struct ControlValue {
  std::string name;
  double number = 0.0;  // where word is empty
  std::string word{};

  [[nodiscard]] bool IsWord() const { return !word.empty(); }
};

// All controls of one fixture, each once: dimmer, cct_K, tint, zoom_deg and modifier first, the
// others by name. Empty: a lamp without controls.
using FixtureState = std::vector<ControlValue>;

inline constexpr std::string_view kDimmerControl = "dimmer";  // percent of full, 0 ... 100
inline constexpr std::string_view kCctControl = "cct_K";      // kelvin, above 0
inline constexpr std::string_view kZoomControl = "zoom_deg";  // degrees

// In the order above.
void SortState(FixtureState& state);
// Whether both say the same of the same controls (numbers within 1e-9 of each other, relative).
[[nodiscard]] bool SameState(const FixtureState& a, const FixtureState& b);
// Whether every word of `a` stands in `b` too.
[[nodiscard]] bool SameWords(const FixtureState& a, const FixtureState& b);
[[nodiscard]] const ControlValue* FindControl(const FixtureState& state, std::string_view name);
// The number of a control; absent where it is a word or not there.
[[nodiscard]] std::optional<double> NumberOfControl(const FixtureState& state,
                                                    std::string_view name);
// The other controls.
[[nodiscard]] FixtureState WithoutDimmer(FixtureState state);
// What is wrong with a state, empty where nothing is: a control twice, a name that no file can
// hold, a dimmer outside 0 ... 100, a colour temperature of 0 or less, a number that is not finite.
[[nodiscard]] std::string FaultOfState(const FixtureState& state);

// "dimmer=50, cct_K=4000".
[[nodiscard]] std::string StateText(const FixtureState& state);
// "dimmer=50"
[[nodiscard]] std::string ControlText(const ControlValue& control);
// "dimmer=50,cct_K=4000,modifier=softbox"; the units of a label may stand: 50%, 4000K, 20deg.
// Fails: usage.
[[nodiscard]] Result<FixtureState> ParseFixtureState(std::string_view text);
// One value as a person types it: a number, with %, K or deg, or else a word.
[[nodiscard]] ControlValue ParseControl(std::string_view name, std::string_view value);

}  // namespace lightcal
