// SPDX-License-Identifier: Apache-2.0
// The page that calculates in a browser: the commands as WebAssembly in one HTML file (app/wasm).
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

inline constexpr std::string_view kPageTarget = "page";

// The page as it was built, beside the program or where it was installed. Fails: no_page (built
// without clang for WebAssembly), unreadable.
[[nodiscard]] Result<std::string> ReadPage();

// The page with these lights in it, shown first. `name`: what it calls them.
// Fails: not_finite, and as ReadPage.
[[nodiscard]] Result<std::string> PageWith(const LightFile& lights, const std::string& name);

}  // namespace lightcal::app
