// SPDX-License-Identifier: Apache-2.0
// The text in front of a Radiance HDR picture. Pure.
#pragma once

#include <optional>
#include <string_view>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/records/projection.h"

namespace lightcal::devices {

struct RadianceHeader {
  double exposure = 1.0;  // product of all EXPOSURE lines: samples are radiance times this
  std::optional<RgbPrimaries> primaries;  // absent when none, or all zeros (Adobe Photoshop)
  bool xyz = false;                       // FORMAT=32-bit_rle_xyze
  // The last VIEW line that says how the picture was projected, by its type and angles
  // (-vta -vv 182: equidistant, -vtv: rect). Other types (-vth, -vts, -vtl, -vtc) are no projection
  // lightcal knows.
  std::optional<WrittenView> view;
  bool unknown_view = false;
};

// `bytes` begin the file; the header ends at the first empty line.
// Refused: bad_picture (no such header, numbers that are none, an exposure that is not positive),
// unsupported_picture (COLORCORR other than 1 1 1).
// Source: Radiance 5, ray/doc/filefmts (Picture File Format).
[[nodiscard]] Result<RadianceHeader> ParseRadianceHeader(std::string_view bytes,
                                                         std::string_view name);

}  // namespace lightcal::devices
