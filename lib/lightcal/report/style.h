// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace lightcal::report {

// The page's style sheet: light and dark by the reader's setting, paper always light.
[[nodiscard]] std::string StyleSheet();

// A figure as a file of its own: the style sheet's part for figures and its own rules inside, and
// who wrote it.
[[nodiscard]] std::string StandaloneSvg(std::string svg, std::string_view own_rules = {});

}  // namespace lightcal::report
