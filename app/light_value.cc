// SPDX-License-Identifier: Apache-2.0
#include "light_value.h"

#include <array>
#include <numbers>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {
namespace {

struct UnitRow {
  std::string_view text;  // lower case
  LightUnit unit;
  double factor;
};
// 1 fL = 1/pi cd/ft^2.
constexpr double kNitsPerFootlambert = kLuxPerFootcandle / std::numbers::pi;
constexpr UnitRow kUnits[] = {
    {"lm", LightUnit::kLumens, 1.0},
    {"klm", LightUnit::kLumens, 1e3},
    {"cd", LightUnit::kCandela, 1.0},
    {"kcd", LightUnit::kCandela, 1e3},
    {"mcd", LightUnit::kCandela, 1e-3},
    {"lx", LightUnit::kLux, 1.0},
    {"lux", LightUnit::kLux, 1.0},
    {"klx", LightUnit::kLux, 1e3},
    {"fc", LightUnit::kLux, kLuxPerFootcandle},
    {"nits", LightUnit::kNits, 1.0},
    {"nit", LightUnit::kNits, 1.0},
    {"cd/m2", LightUnit::kNits, 1.0},
    {"cd/m^2", LightUnit::kNits, 1.0},
    {"cd/m\xC2\xB2", LightUnit::kNits, 1.0},
    {"knits", LightUnit::kNits, 1e3},
    {"fl", LightUnit::kNits, kNitsPerFootlambert},
    {"lm/m2", LightUnit::kExitance, 1.0},
    {"lm/m^2", LightUnit::kExitance, 1.0},
    {"w", LightUnit::kWatts, 1.0},
    {"kw", LightUnit::kWatts, 1e3},
};

}  // namespace

Result<LightValue> ParseLightValue(const std::string& text) {
  const auto split = SplitNumberAndUnit(text);
  if (!split) return tl::unexpected(split.error());
  const std::string unit = LowerAscii(split->unit);
  for (const UnitRow& row : kUnits) {
    if (row.text == unit) return LightValue{row.unit, split->number * row.factor};
  }
  const std::string problem =
      unit.empty() ? "a unit is needed" : "unknown unit \"" + std::string(split->unit) + "\"";
  return WrongUsage(text,
                    problem +
                        "; write 806lm (flux), 64cd (intensity), 190lx or 17.8fc "
                        "(illuminance), 1500nits or 14fL (luminance), 60W (electrical power)");
}

std::string_view LightUnitText(LightUnit unit) {
  constexpr std::array<std::string_view, 6> kTexts = {"lm", "cd", "lx", "cd/m²", "lm/m²", "W"};
  return kTexts[static_cast<std::size_t>(unit)];
}

Result<double> ParseInUnit(const std::string& text, std::string_view unit_lower_case) {
  const auto split = SplitNumberAndUnit(text);
  if (!split) return tl::unexpected(split.error());
  if (!split->unit.empty() && LowerAscii(split->unit) != unit_lower_case) {
    return WrongUsage(text, "the unit \"" + std::string(split->unit) +
                                "\" does not fit here; use " + std::string(unit_lower_case));
  }
  return split->number;
}

Result<double> ParsePlainNumber(const std::string& option, const std::string& text) {
  const auto number = ParseNumber(text);
  if (!number) return WrongUsage(option, "\"" + text + "\" is not a number");
  return *number;
}

}  // namespace lightcal::app
