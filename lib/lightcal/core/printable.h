// SPDX-License-Identifier: Apache-2.0
// Text from files and command lines that is shown to a person: nothing in it may steer a terminal
// or show a line in another order than it has.
#pragma once

#include <string>
#include <string_view>

namespace lightcal {

// Whether text is whole UTF-8 without control characters (U+0000 to 001F, 007F to 009F), line and
// paragraph separators (U+2028, 2029) and characters that turn the direction of writing (U+061C,
// 200E, 200F, 202A to 202E, 2066 to 2069).   Source: Unicode 15, UAX 9, table of explicit
// directional characters; Unicode TR 36, 2.7.
[[nodiscard]] bool IsPrintable(std::string_view utf8);

// The same text with each such character as "\u001b" reads; line feeds and tabs stay, bytes that
// are no UTF-8 become U+FFFD. Inside of JSON's quotes it means what it meant.
[[nodiscard]] std::string Printable(std::string_view utf8);

}  // namespace lightcal
