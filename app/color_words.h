// SPDX-License-Identifier: Apache-2.0
// Whites and RGB spaces as people type them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// "0.3127,0.3290", "3200K" (Planckian), "D65"; `option` stands in messages.
[[nodiscard]] Result<Xy> ParseWhite(const std::string& option, const std::string& text);
inline constexpr std::array<std::string_view, 5> kSpaceWords = {"rec709", "srgb", "acescg",
                                                                "rec2020", "p3"};
// One of kSpaceWords; "srgb" is "rec709".
[[nodiscard]] Result<RgbSpace> ParseSpace(const std::string& option, const std::string& text);

// --space and --white as a person gave them; absent where they did not.
struct ColorWords {
  std::optional<RgbSpace> space;
  std::optional<Xy> white;
};
[[nodiscard]] Result<ColorWords> ParseColorWords(const std::string& space,
                                                 const std::string& white);

}  // namespace lightcal::app
