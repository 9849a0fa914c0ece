// SPDX-License-Identifier: Apache-2.0
// Values with units as people type them on the command line. A bare number is SI.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// "0.5m" "50cm" "500mm" "20in" "2ft" "0.5", feet and inches together "1ft8in" "1'8\"" "5' 8 1/2\"",
// the inches below 12.  1 in = 0.0254 m, 1 ft = 0.3048 m exactly.
[[nodiscard]] Result<Metres> ParseLength(std::string_view text);
// "192lx" "17.8fc" "1.2klx" "192".  1 fc = 1 lm/ft^2 = 1/0.3048^2 lx = 10.7639 lx.
[[nodiscard]] Result<Lux> ParseIlluminance(std::string_view text);
// "1/60" "60s" "2ms" "2".  A bare fraction is seconds.
[[nodiscard]] Result<Seconds> ParseDuration(std::string_view text);
// "f/2.8" "2.8"
[[nodiscard]] Result<double> ParseFNumber(std::string_view text);
// "3200K" "3200"
[[nodiscard]] Result<Kelvin> ParseTemperature(std::string_view text);
// "36" "36deg" "0.6rad"; bare degrees.
[[nodiscard]] Result<Radians> ParseAngle(std::string_view text);

// A number followed by a unit word, split: "806lm" -> {806, "lm"}. The number may be a fraction
// "1/60". Fails (kUsage) when the number is missing or not finite.
struct NumberWithUnit {
  double number = 0.0;
  std::string_view unit;
};
[[nodiscard]] Result<NumberWithUnit> SplitNumberAndUnit(std::string_view text);

// "OL", "Over": what meters show of light above their range, which says no number.
[[nodiscard]] bool IsOverloadWord(std::string_view text);
// '>' of ">400", '<' of "< 40": a limit instead of a number, the end of the meter's range that the
// light lies beyond; else '\0'.
[[nodiscard]] char LimitSignOf(std::string_view text);
inline constexpr std::string_view kWriteALimit =
    "light beyond the meter's range is written as a limit, the end of that range: >20000";

inline constexpr double kMetresPerFoot = 0.3048;  // exactly
inline constexpr double kLuxPerFootcandle = 1.0 / (kMetresPerFoot * kMetresPerFoot);

}  // namespace lightcal
