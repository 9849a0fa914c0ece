// SPDX-License-Identifier: Apache-2.0
// Are a bracket's shutters whole numbers of a flickering lamp's periods?
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/photometry/lamp_flicker.h"
#include "lightcal/records/frame.h"

namespace lightcal::app {

// What the lamps may do. `mains`: one of these flickers, nobody knows which; a shutter safe under
// either passes. `pwm`: this lamp does.
struct LampsOnSet {
  std::vector<LampFlicker> mains{{.frequency_hz = 100.0}, {.frequency_hz = 120.0}};
  std::optional<LampFlicker> pwm;
};

inline constexpr std::array<std::string_view, 3> kMainsWords = {"50", "60", "none"};
// --mains, one of kMainsWords, and --pwm HZ[,DUTY], empty = not given.
[[nodiscard]] Result<LampsOnSet> ParseLamps(const std::string& mains, const std::string& pwm);

// flicker_unsafe_shutter, once for all frames whose worst error (WorstFlickerError) is above 3 %,
// what shutters themselves repeat to; names safe shutters. Frames without a time are passed over.
[[nodiscard]] Warnings CheckShutters(std::span<const FrameInfo> frames, const LampsOnSet& lamps);

// Refused: flicker_unsafe_shutter, a single frame of a lamp stated to pulse (--pwm) that may read
// more than twice its light or miss it altogether; of a bracket the other frames tell.
[[nodiscard]] Result<void> RefuseHopelessShutter(std::span<const FrameInfo> frames,
                                                 const LampsOnSet& lamps);

}  // namespace lightcal::app
