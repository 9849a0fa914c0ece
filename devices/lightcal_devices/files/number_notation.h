// SPDX-License-Identifier: Apache-2.0
// Which sign parts decimals and which thousands in a table: its own cells tell, or nobody does.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lightcal::devices::files {

// What one cell tells of the signs in it.
//   192,5  0,125  1,34E+02  12.030,5   a comma before decimals
//   12,030.5  1,203,400                a comma between thousands
//   8,120                              either: one sign, one to three digits before it, three
//                                      behind
struct SignsOfCell {
  bool comma_decimal = false, point_decimal = false;
  bool comma_parts = false, point_parts = false;
  char open = '\0';  // the sign that may be either
};
// All false where the cell is no number. Blanks and apostrophes may part thousands too and leave
// nothing open.
[[nodiscard]] SignsOfCell SignsOf(std::string_view cell);

struct NumberNotation {
  char decimal = '.';
  char thousands = '\0';  // ',' or '.' where the file tells, else none
};

// The number, thousands parted in groups of three by the notation's sign, by blanks (of any width)
// or apostrophes. Absent when anything else is there.
[[nodiscard]] std::optional<double> NumberIn(std::string_view cell, const NumberNotation& notation);

// An open cell by both its meanings: 8120 and 8.12.
struct TwoMeanings {
  double thousands = 0.0, decimals = 0.0;
};
[[nodiscard]] TwoMeanings MeaningsOf(std::string_view open_cell);

}  // namespace lightcal::devices::files
