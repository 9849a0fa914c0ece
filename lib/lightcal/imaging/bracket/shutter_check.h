// SPDX-License-Identifier: Apache-2.0
// Are a bracket's shutters whole numbers of a flickering lamp's periods?
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/photometry/lamp_flicker.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// What the lamps may do. `mains`: one of these flickers, nobody knows which; a shutter safe under
// either passes. `pwm`: this lamp does.
struct LampsOnSet {
  std::vector<LampFlicker> mains{{.frequency_hz = 100.0}, {.frequency_hz = 120.0}};
  std::optional<LampFlicker> pwm;
};

// flicker_unsafe_shutter, once for all frames whose worst error (WorstFlickerError) is above 3 %,
// what shutters themselves repeat to; names safe shutters. Frames without a time are passed over.
[[nodiscard]] Warnings CheckShutters(std::span<const FrameInfo> frames, const LampsOnSet& lamps);

// Refused: flicker_unsafe_shutter, a single frame of a lamp stated to pulse that may read
// more than twice its light or miss it altogether; of a bracket the other frames tell.
[[nodiscard]] Result<void> RefuseHopelessShutter(std::span<const FrameInfo> frames,
                                                 const LampsOnSet& lamps);

}  // namespace lightcal
