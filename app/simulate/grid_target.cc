// SPDX-License-Identifier: Apache-2.0
#include "simulate/grid_target.h"

#include <array>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "simulate/simulate_answer.h"

namespace lightcal::app {

Result<GridTarget> ParseGridTarget(const std::string& text) {
  GridTarget target;
  constexpr const char* kForm = "a target is written 500lx or 500lx,min=300lx,U0=0.6";
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    begin = comma + 1;
    const auto equals = part.find('=');
    const std::string word =
        equals == std::string::npos ? "mean" : LowerAscii(part.substr(0, equals));
    const std::string value = equals == std::string::npos ? part : part.substr(equals + 1);
    if (word == "u0") {
      const auto number = ParseNumber(value);
      if (!number || !(*number > 0.0) || *number > 1.0) return WrongUsage(part, kForm);
      target.uniformity = *number;
      continue;
    }
    const auto lux = ParseIlluminance(value);
    if (!lux || !(lux->value() > 0.0) || (word != "mean" && word != "min")) {
      return WrongUsage(part, kForm);
    }
    (word == "mean" ? target.mean_lx : target.least_lx) = lux->value();
  }
  return target;
}

std::vector<GridVerdict> JudgeGrid(const GridTarget& target, const MapSummary& found) {
  using Word = GridVerdict::Word;
  std::vector<GridVerdict> verdicts;
  const auto judge = [&](std::string_view what, const std::optional<double>& asked, double value,
                         double u95) {
    if (!asked) return;
    Word word = value >= *asked ? Word::kMet : Word::kMissed;
    if (value - u95 < *asked && value + u95 > *asked) word = Word::kOpen;
    verdicts.push_back({what, *asked, value, word});
  };
  const double u = found.median_u95_relative;
  judge("mean_lx", target.mean_lx, found.mean_lx, u * found.mean_lx);
  judge("min_lx", target.least_lx, found.least_lx, u * found.least_lx);
  const double u0 = found.mean_lx > 0.0 ? found.least_lx / found.mean_lx : 0.0;
  judge("U0", target.uniformity, u0, 0.0);
  return verdicts;
}

std::string_view WordOf(GridVerdict::Word word) {
  constexpr std::array<std::string_view, 3> kWords = {"met", "missed", "open"};
  return kWords[static_cast<std::size_t>(word)];
}

}  // namespace lightcal::app
