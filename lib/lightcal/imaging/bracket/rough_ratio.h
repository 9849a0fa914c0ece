// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

namespace lightcal {

inline constexpr double kLeastSharedSamples = 64.0;  // that tell a ratio of two frames

// A first exposure ratio b/a that needs no label: what most of it is where both stand clear of
// noise and clip. Absent where fewer than kLeastSharedSamples do.
[[nodiscard]] std::optional<double> RoughRatio(std::span<const float> a, std::span<const float> b,
                                               std::span<const float> clip);

}  // namespace lightcal
