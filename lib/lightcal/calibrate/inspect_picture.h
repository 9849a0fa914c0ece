// SPDX-License-Identifier: Apache-2.0
// One picture of any kind -> luminances.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/scene/picture_luminance.h"
#include "lightcal/records/bracket.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// A picture as luminances, and where its scale is from.
struct InspectedPicture {
  FrameInfo info;
  PictureLuminance luminance;  // NaN where masked
  std::optional<double> scale_u95_relative;
  std::vector<std::size_t> masked{};  // pixels, y * width + x
  Warnings warnings{};
  // Pixels that end where the picture does, far above the rest: row * width + column.
  std::vector<std::size_t> cut_off{};
};

// A RAW is a bracket of one frame, whose exposure `overrides` may give: its luminance is by the ISO
// prior. A linear picture is as `convention` says and its own attributes tell.
// Refused: no_response (codes through a camera's response curve), and as MergeBracket,
// Sources::read_masked_frame, LuminanceOfPicture.
[[nodiscard]] Result<InspectedPicture> InspectPicture(const std::string& path,
                                                      const Sources& sources,
                                                      const BracketOverrides& overrides,
                                                      LuminanceConvention convention);

}  // namespace lightcal
