// SPDX-License-Identifier: Apache-2.0
// A lamp's value as people type it: 806lm, 64cd, 190lx, 1500nits, 60W.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::app {

enum class LightUnit { kLumens, kCandela, kLux, kNits, kExitance, kWatts };

struct LightValue {
  LightUnit unit = LightUnit::kLumens;
  double value = 0.0;  // in lm, cd, lx, cd/m2, lm/m2 or W
};

// lm klm; cd kcd mcd; lx lux klx fc; nits nit cd/m2 knits fL; lm/m2; W kW mW, in any case of
// letters except that mcd is millicandela. A unit is required: a bare number could mean any of
// them. Fails (usage) with the list of units.
[[nodiscard]] Result<LightValue> ParseLightValue(const std::string& text);

// "lm" "cd" "lx" "cd/m²" "lm/m²" "W"
[[nodiscard]] std::string_view LightUnitText(LightUnit unit);

// A number in the given unit word, or bare: ("10lm/W", "lm/w"). Fails (usage) on another unit.
[[nodiscard]] Result<double> ParseInUnit(const std::string& text, std::string_view unit_lower_case);

// A plain number: "0.9". Fails (usage), naming the option.
[[nodiscard]] Result<double> ParsePlainNumber(const std::string& option, const std::string& text);

}  // namespace lightcal::app
