// SPDX-License-Identifier: Apache-2.0
// The noise of a bracket's sensor, from the bracket itself.
#pragma once

#include <optional>
#include <span>

#include "lightcal/imaging/bracket/sampled.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// Var(signal) = scale signal + offset of frames taken at one ISO, from the residuals d = b - r a of
// neighbours in exposure:
//   Var d = scale m r (1 + r) + offset (1 + r^2),      m the signal in a, r = exposure b/a
// What repeats from frame to frame (unequal pixels, vignetting, the scene) cancels in d. Residuals
// beyond four standard deviations are left out. Absent when no two frames share enough samples.
// `exposure`: of each frame, any unit, ascending.
[[nodiscard]] std::optional<NoiseProfile> EstimateNoise(const SampledSignals& signals,
                                                        std::span<const double> exposure,
                                                        std::span<const double> shares = {});

// What a middling sensor does, where nothing else is known: 40 000 electrons at full scale, 5 of
// read noise.
inline constexpr NoiseProfile kMiddlingNoise{1.0 / 40'000.0, 5.0 * 5.0 / (40'000.0 * 40'000.0)};

// Pixels of one sensor differ in sensitivity by about this, where it cannot be measured.
// Source: EMVA 1288 data sheets give 0.3-1 %.
inline constexpr double kMiddlingFixedPattern = 0.005;

}  // namespace lightcal
