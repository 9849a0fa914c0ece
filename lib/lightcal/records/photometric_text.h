// SPDX-License-Identifier: Apache-2.0
// Text that IES and EULUMDAT files share. Internal to the records room.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::records {

// Lines one after the other: LF, CRLF or CR, a byte order mark dropped, blanks trimmed.
class Lines {
 public:
  explicit Lines(std::string_view text);
  // Absent at the end.
  [[nodiscard]] std::optional<std::string_view> Next();
  [[nodiscard]] int number() const { return number_; }  // of the line last given, from 1
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

// A number with decimal point or comma.
[[nodiscard]] std::optional<double> NumberEitherWay(std::string_view text);

// `digits` significant ones, never an exponent, no trailing zeros.
[[nodiscard]] std::string PlainNumber(double value, int digits);

// Printable text for a message or a header field: UTF-8, bytes that are not taken as ISO 8859-1,
// control characters as blanks, at most 256 bytes.
[[nodiscard]] std::string HeaderText(std::string_view bytes);
// The way back; what the target has no character for becomes '?'.
[[nodiscard]] std::string AsciiFromUtf8(std::string_view utf8);
[[nodiscard]] std::string Latin1FromUtf8(std::string_view utf8);

// What a lamp may have, generously.
inline constexpr double kLeastLumens = 1e-9;
inline constexpr double kMostLumens = 1e15;

// Of EULUMDAT: what stands between date and user on line 12, and how many direct ratios follow.
inline constexpr std::string_view kEulumdatLab = " / ";
inline constexpr int kEulumdatDirectRatios = 10;

[[nodiscard]] tl::unexpected<Error> BadPhotometric(std::string_view where, const std::string& why);
// Of "vertical", "gamma" ... angles, one of which does not exceed the one before it: bad_table.
[[nodiscard]] tl::unexpected<Error> AnglesMustIncrease(std::string_view where,
                                                       std::string_view which, double before,
                                                       double angle, int line);

}  // namespace lightcal::records
