// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/fixture_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"

namespace lightcal {
namespace {

constexpr std::array<std::string_view, 5> kFirst = {kDimmerControl, kCctControl, "tint",
                                                    kZoomControl, "modifier"};
constexpr std::size_t kLongestName = 40;

std::pair<std::size_t, std::string_view> OrderOf(const ControlValue& control) {
  const auto rank = static_cast<std::size_t>(
      std::ranges::find(kFirst, std::string_view(control.name)) - kFirst.begin());
  return {rank, control.name};
}

bool SameNumber(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool IsControlName(std::string_view name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.size() <= kLongestName && std::ranges::all_of(name, fits);
}

}  // namespace

void SortState(FixtureState& state) {
  std::ranges::sort(
      state, [](const ControlValue& a, const ControlValue& b) { return OrderOf(a) < OrderOf(b); });
}

bool SameState(const FixtureState& a, const FixtureState& b) {
  return std::ranges::equal(a, b, [](const ControlValue& one, const ControlValue& other) {
    return one.name == other.name && one.word == other.word && SameNumber(one.number, other.number);
  });
}

bool SameWords(const FixtureState& a, const FixtureState& b) {
  return std::ranges::all_of(a, [&](const ControlValue& control) {
    if (!control.IsWord()) return true;
    const ControlValue* there = FindControl(b, control.name);
    return there != nullptr && there->word == control.word;
  });
}

const ControlValue* FindControl(const FixtureState& state, std::string_view name) {
  const auto found = std::ranges::find(state, name, &ControlValue::name);
  return found == state.end() ? nullptr : &*found;
}

std::optional<double> NumberOfControl(const FixtureState& state, std::string_view name) {
  const ControlValue* control = FindControl(state, name);
  if (control == nullptr || control->IsWord()) return std::nullopt;
  return control->number;
}

FixtureState WithoutDimmer(FixtureState state) {
  std::erase_if(state, [](const ControlValue& one) { return one.name == kDimmerControl; });
  return state;
}

std::string FaultOfState(const FixtureState& state) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    const ControlValue& control = state[i];
    const std::string named = "state." + Printable(control.name);
    if (!IsControlName(control.name)) {
      return named + ": a control's name has letters, digits and _, at most 40 of them";
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (state[j].name == control.name) return named + " is given twice";
    }
    if (control.word.size() > kLongestName) return named + ": the word is longer than 40 bytes";
    if (control.IsWord()) {
      const bool number = control.name == kDimmerControl || control.name == kCctControl ||
                          control.name == kZoomControl;
      if (number) return named + " must be a number";
      continue;
    }
    if (!std::isfinite(control.number)) return named + " must be a finite number";
    if (control.name == kDimmerControl && (control.number < 0.0 || control.number > 100.0)) {
      return named + " must lie between 0 and 100 %";
    }
    if (control.name == kCctControl && !(control.number > 0.0)) return named + " must be above 0";
  }
  return {};
}

std::string StateText(const FixtureState& state) { return Joined(state, ", ", ControlText); }

std::string ControlText(const ControlValue& control) {
  return control.name + "=" + (control.IsWord() ? control.word : ShortestText(control.number));
}

ControlValue ParseControl(std::string_view name, std::string_view value) {
  ControlValue control{std::string(TrimBlanks(name)), 0.0, {}};
  const std::string_view whole = TrimBlanks(value);
  std::string_view bare = whole;
  for (const std::string_view unit : {"%", "deg", "K"}) {
    if (bare.ends_with(unit) && bare.size() > unit.size()) {
      bare.remove_suffix(unit.size());
      break;
    }
  }
  if (const auto number = ParseNumber(bare)) {
    control.number = *number;
  } else {
    control.word = std::string(whole);
  }
  return control;
}

Result<FixtureState> ParseFixtureState(std::string_view text) {
  FixtureState state;
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view one = rest.substr(0, comma);
    const std::size_t equals = one.find('=');
    if (equals == std::string_view::npos || TrimBlanks(one.substr(equals + 1)).empty()) {
      return WrongUsage(std::string(text),
                        "write what each control says, such as dimmer=50,cct_K=4000");
    }
    state.push_back(ParseControl(one.substr(0, equals), one.substr(equals + 1)));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (const std::string fault = FaultOfState(state); !fault.empty()) {
    return WrongUsage(std::string(text), fault);
  }
  SortState(state);
  return state;
}

}  // namespace lightcal
