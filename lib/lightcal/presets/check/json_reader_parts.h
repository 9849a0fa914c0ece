// SPDX-License-Identifier: Apache-2.0
// What the readers of presets in JSON share. All throw std::exception with what is wrong.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lightcal/presets/check/reader_parts.h"

namespace lightcal {

[[nodiscard]] Vec3 VecFrom(const nlohmann::json& three);
// Luminance of linear Rec. 709.
[[nodiscard]] double LuminanceFrom(const nlohmann::json& rgb);
// The value of "distance_offset_m"; 0 where there is none.
[[nodiscard]] double OffsetIn(const nlohmann::json& extras);

// The {...} that starts at or after `from`, by its braces.
[[nodiscard]] std::string ObjectFrom(const std::string& text, std::size_t from);

// Every one of "lights".
[[nodiscard]] std::vector<EngineLight> EachLight(const nlohmann::json& root,
                                                 EngineLight (*read)(const nlohmann::json&));

}  // namespace lightcal
