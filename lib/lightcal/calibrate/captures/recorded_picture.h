// SPDX-License-Identifier: Apache-2.0
// The pictures that captures are read from, kept small for the report.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct MergedBracket;

// In cd/m^2; no side longer than kLongestRecordedSide.
struct RecordedPicture {
  std::string light, use;  // "wall", "card", ...
  int width = 0, height = 0;
  std::vector<float> nits;
  std::optional<std::array<double, 4>> region{};  // x, y, width, height of what was measured
};
inline constexpr int kLongestRecordedSide = 400;

// The picture of a capture. factor: cd/m^2 per unit of the merged picture's luminance.
[[nodiscard]] RecordedPicture RecordedOf(const CaptureDescription& capture,
                                         View2d<const float> nits);
[[nodiscard]] RecordedPicture RecordedOf(const CaptureDescription& capture,
                                         const MergedBracket& merged, double factor);

}  // namespace lightcal
