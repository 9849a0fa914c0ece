// SPDX-License-Identifier: Apache-2.0
// Light that changed in part of the picture between two frames of a bracket.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "lightcal/imaging/bracket/sampled.h"
#include "lightcal/imaging/bracket/signal.h"

namespace lightcal {

// ln of b/a in regions of the picture: a tenth of what is seen lies below, a tenth above.
struct RatioRange {
  double low = 0.0, high = 0.0;
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double width() const { return high - low; }
};

// Of 8 x 16 regions, sum b / sum a over samples well exposed in both, chosen by a + b at the ratio
// `ratio`. Absent where they agree: within 1 % and six standard deviations of their scatter; where
// fewer than eight are seen; and where rows alternate (a pulsed lamp under a rolling shutter).
[[nodiscard]] std::optional<RatioRange> DisagreeingRegions(const SampledSignals& signals,
                                                           std::size_t a, std::size_t b,
                                                           std::span<const float> clip,
                                                           double ratio);

// Whether what regions disagree about goes, at least by half, where `a` is shifted: the camera
// moved. `ratio`: of exposures, b/a. Reads both frames.
[[nodiscard]] bool IsShift(const SignalFrame& a, const SignalFrame& b, double ratio);

// Asked of frames a and b whose exposures have the ratio b/a.
using ShiftTest = std::function<bool(std::size_t a, std::size_t b, double ratio)>;

}  // namespace lightcal
