// SPDX-License-Identifier: Apache-2.0
// The library names fields of its requests, and what it does, in braces: "give {merge.noise}". Who
// types a command knows options: "give --noise".
#pragma once

#include <string>
#include <string_view>

namespace lightcal::app {

// The text with every known {field} as the command line spells it; other braces stay.
[[nodiscard]] std::string InOptionWords(std::string_view text);

}  // namespace lightcal::app
