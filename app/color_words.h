// SPDX-License-Identifier: Apache-2.0
// Whites and RGB spaces as people type them.
#pragma once

#include <optional>
#include <string>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// "0.3127,0.3290", "3200K" (Planckian), "D65"; `option` stands in messages.
[[nodiscard]] Result<Xy> ParseWhite(const std::string& option, const std::string& text);
// "rec709" (or "srgb"), "acescg", "rec2020", "p3".
[[nodiscard]] Result<RgbSpace> ParseSpace(const std::string& option, const std::string& text);

// --space and --white as a person gave them; absent where they did not.
struct ColorWords {
  std::optional<RgbSpace> space;
  std::optional<Xy> white;
};
[[nodiscard]] Result<ColorWords> ParseColorWords(const std::string& space,
                                                 const std::string& white);

}  // namespace lightcal::app
