// SPDX-License-Identifier: Apache-2.0
// Many lamps' answers: a row each, and what to do next, alike steps together.
#include <algorithm>
#include <functional>

#include "console.h"
#include "lamp_answer.h"
#include "lamp_words.h"
#include "lightcal/core/stops.h"

namespace lightcal::app {
namespace {

constexpr std::size_t kNamesShown = 3;

std::string Names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamesShown); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > kNamesShown
             ? text + " and " + std::to_string(names.size() - kNamesShown) + " more"
             : text;
}

// Steps of one kind, in the order met.
struct AlikeSteps {
  std::string what;
  std::vector<const LampAnswer*> lamps;
};

std::string WhatKind(const LampAnswer& answer) {
  const NextStepAdvice& next = answer.next;
  if (next.kind == NextStepAdvice::Kind::kMeter) return "the meter is the limit";
  if (next.kind != NextStepAdvice::Kind::kReading) return next.say;
  switch (next.reading->action) {
    case PlannedAction::kShadowCard:
      return "block the direct beam with a card and read what is left";
    case PlannedAction::kLampOff:
      return "read once with the lamp off";
    case PlannedAction::kRead:
      break;
  }
  return next.reading->distance ? "read at one more distance" : "read at one more place";
}

std::string AlikeLine(const AlikeSteps& steps) {
  std::vector<std::string> names;
  const LampAnswer* worst = steps.lamps.front();
  const auto stops = [](const LampAnswer* one) {
    const Strength strength = StrengthOf(*one->light);
    return strength.value == nullptr ? 0.0 : HalfWidthStops(*strength.value).value_or(99.0);
  };
  for (const LampAnswer* lamp : steps.lamps) {
    names.push_back(lamp->label);
    if (stops(lamp) > stops(worst)) worst = lamp;
  }
  std::string text = steps.what + ": " + Names(names);
  if (worst->next.kind == NextStepAdvice::Kind::kReading) {
    text += ". " + worst->label + " first: " + worst->better + ": " +
            StopsText(worst->next.reading->u95_stops);
  }
  return LabelledLine(
      "next, " + std::to_string(names.size()) + (names.size() == 1 ? " lamp" : " lamps"), text);
}

std::string NextOfMany(const std::vector<LampAnswer>& answers) {
  std::vector<AlikeSteps> groups;
  for (const LampAnswer& answer : answers) {
    const std::string what = WhatKind(answer);
    auto same = std::ranges::find(groups, what, &AlikeSteps::what);
    if (same == groups.end()) same = groups.insert(groups.end(), AlikeSteps{what, {}});
    same->lamps.push_back(&answer);
  }
  std::ranges::stable_sort(groups, std::ranges::greater(),
                           [](const AlikeSteps& one) { return one.lamps.size(); });
  std::string text;
  for (const AlikeSteps& group : groups) text += AlikeLine(group);
  return text;
}

}  // namespace

std::string LampAnswersTable(const std::vector<LampAnswer>& answers) {
  std::vector<std::string> head = {"lamp",   "",        "low … high", "stops",
                                   "colour", "type in", "enough for"};
  std::vector<std::vector<std::string>> rows;
  for (const LampAnswer& answer : answers) {
    const Strength strength = StrengthOf(*answer.light);
    std::vector<std::string> row = {answer.label, "-", "-", "-", "-", "-", "-"};
    if (strength.value != nullptr) {
      const auto stops = HalfWidthStops(*strength.value);
      row[1] = (stops ? ValueText(*strength.value) : "below " + UpperEndText(*strength.value)) +
               " " + std::string(strength.unit);
      row[2] = RangeText(*strength.value);
      if (stops) row[3] = "± " + BareStops(*stops);
      if (stops && !EnoughFor(*stops).empty()) row[6] = EnoughFor(*stops);
    }
    if (!answer.color.empty()) row[4] = answer.color;
    if (!answer.figures.empty()) row[5] = TypeIn({answer.figures.front()});
    rows.push_back(std::move(row));
  }
  return TextTable(head, rows) + "\n" + NextOfMany(answers);
}

}  // namespace lightcal::app
