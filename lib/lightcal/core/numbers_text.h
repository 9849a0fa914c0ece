// SPDX-License-Identifier: Apache-2.0
// Numbers to and from text, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lightcal {

// Shortest text that reads back as the same double ("0.1", "1e-07"). Source: std::to_chars.
// A value that is not finite has no text in our files; callers keep it out. -0 is written "0".
[[nodiscard]] std::string ShortestText(double value);
// Text with a fixed number of significant digits, for tables people read ("5585", "0.0671").
[[nodiscard]] std::string RoundedText(double value, int significant_digits);
// "4.2 %" of 0.042.
[[nodiscard]] std::string PercentText(double relative, int significant_digits = 2);

// The whole text as one finite number: surrounding blanks allowed, '.' decimal point, exponent
// allowed. decimal_comma reads "1,34E+00". Absent when anything else is there.
[[nodiscard]] std::optional<double> ParseNumber(std::string_view text, bool decimal_comma = false);

[[nodiscard]] std::string_view TrimBlanks(std::string_view text);
[[nodiscard]] std::string LowerAscii(std::string_view text);

}  // namespace lightcal
