// SPDX-License-Identifier: Apache-2.0
#include "guide/step_answer.h"

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {
namespace {

Result<Metres> ParseDistance(const std::string& text) {
  auto distance = ParseLength(text);
  if (!distance || distance->value() > 0.0) return distance;
  return WrongUsage(text, "a distance must be above zero");
}

Result<StepAnswer> MovedTo(const std::string& text) {
  const auto distance = ParseDistance(text);
  if (!distance) return tl::unexpected(distance.error());
  return StepAnswer{StepAnswer::Kind::kMoved, "", *distance};
}

// "0.8m", and not "192lx" or "192".
bool IsLengthWithUnit(const std::string& text) {
  const auto split = SplitNumberAndUnit(text);
  return split && !split->unit.empty() && ParseLength(text).has_value();
}

}  // namespace

Result<StepAnswer> ParseStepAnswer(const std::string& text, bool typed) {
  const std::string answer(TrimBlanks(text));
  const std::string word = LowerAscii(answer);
  if (word == "s" || word == "skip") return StepAnswer{StepAnswer::Kind::kSkip, "", {}};
  if (word == "u" || word == "undo") return StepAnswer{StepAnswer::Kind::kUndo, "", {}};
  if (word == "q" || word == "quit") return StepAnswer{StepAnswer::Kind::kQuit, "", {}};
  if (word.starts_with("at ")) return MovedTo(answer.substr(3));
  if (word.starts_with('@')) return MovedTo(answer.substr(1));
  if (IsLengthWithUnit(answer)) return MovedTo(answer);
  if (!typed) {
    if (answer.empty()) return StepAnswer{};
    if (ParseNumber(answer)) return MovedTo(answer);
    return WrongUsage("\"" + text + "\"",
                      "is not understood: press Enter to measure, or type a distance such as 0.8m, "
                      "s to skip, q to stop");
  }
  if (answer.empty()) {
    return WrongUsage("",
                      "type what the display shows, for example 192 or 17.8fc; s skips, q stops");
  }
  StepAnswer reading{StepAnswer::Kind::kTyped, answer.substr(0, answer.find('@')), {}};
  if (const auto at = answer.find('@'); at != std::string::npos) {
    const auto distance = ParseDistance(answer.substr(at + 1));
    if (!distance) return tl::unexpected(distance.error());
    reading.distance = *distance;
  }
  return reading;
}

}  // namespace lightcal::app
