// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace lightcal::report {

// The page's style sheet: light and dark by the reader's setting, paper always light.
[[nodiscard]] std::string_view StyleSheet();

}  // namespace lightcal::report
