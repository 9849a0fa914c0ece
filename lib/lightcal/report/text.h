// SPDX-License-Identifier: Apache-2.0
// Text as the report shows it: escaped, with the digits an uncertainty leaves.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lightcal/core/uncertain.h"

namespace lightcal::report {

// Safe as HTML and XML text and attribute: & < > " ' become entities; control characters and bytes
// that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string Escaped(std::string_view text);

// A number for axes and tables: at most 6 significant digits, no trailing zeros, a true minus sign,
// thin spaces between thousands from 10 000.
[[nodiscard]] std::string Figure(double value);
// The same with exactly so many decimals (negative: rounded to tens, hundreds ...).
[[nodiscard]] std::string Fixed(double value, int decimals);

// Decimals that show an uncertainty with two significant digits; negative for large ones.
[[nodiscard]] int DecimalsFor(double u95);

// "12 570 ± 500 lm"; of an interval with uneven arms "1260 lm, 11 … 1330"; without an uncertainty
// four significant digits. scale multiplies all.
[[nodiscard]] std::string PlusMinus(const Uncertain& u, std::string_view unit, double scale = 1.0);
// "± 4.0 %" of the value, of uneven arms "−99 … +5.6 %"; "" when there is no uncertainty.
[[nodiscard]] std::string RelativePlusMinus(const Uncertain& u);
// "961 … 1041 cd", the ends of the interval.
[[nodiscard]] std::string Interval(const Uncertain& u, std::string_view unit);
// "1.2 %", or an em dash when absent.
[[nodiscard]] std::string Percent(const std::optional<double>& relative);
// "+1.0 %" / "−1.5 %"
[[nodiscard]] std::string SignedPercent(double relative);

}  // namespace lightcal::report
