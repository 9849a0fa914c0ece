// SPDX-License-Identifier: Apache-2.0
// Frames of known length in a stream that may be joined anywhere: after noise, or in mid-frame.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/cancellation.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal {

struct FrameSearch {
  std::size_t frame_bytes = 0;
  // Whether these bytes, a frame's length or fewer, could be its first ones.
  bool (*may_begin)(std::span<const std::byte> bytes) = nullptr;
  std::size_t most_bytes = 0;            // of noise and frame together, before giving up
  int waits = 1;                         // silences of `wait` that are borne
  std::chrono::milliseconds wait{1000};  // for the next piece
  std::string hint;  // what to do when the line is silent: "is its USB switched on?"
};

// The next whole frame that `may_begin` accepts. Asks the line for no byte beyond it, and decides
// by its bytes and by counted silences alone, so that a recorded search replays. Fails: the line's
// own faults; timeout when nothing came; bad_reply when bytes came but no frame; interrupted.
[[nodiscard]] Result<Bytes> FindFrame(Transport& transport, const FrameSearch& search,
                                      const Cancellation& cancellation);

// What a cancelled dialogue answers.
[[nodiscard]] tl::unexpected<Error> Interrupted(const std::string& device);

// After these nothing more can be said to the device.
[[nodiscard]] bool IsGone(const Error& error);

}  // namespace lightcal
