// SPDX-License-Identifier: Apache-2.0
// Frames of known length in a stream that may be joined anywhere: after noise, or in mid-frame.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/cancellation.h"
#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

struct FrameSearch {
  std::size_t frame_bytes = 0;
  // Whether these bytes, a frame's length or fewer, could be its first ones.
  bool (*may_begin)(std::span<const std::byte> bytes) = nullptr;
  std::size_t most_bytes = 0;            // of noise and frame together, before giving up
  int waits = 1;                         // silences of `wait` that are borne
  std::chrono::milliseconds wait{1000};  // for the next piece
  std::string_view hint = {};  // what to do when the line is silent: "is its USB switched on?"
  // The code of a whole frame that FirstDecoded passes over, "" = none.
  std::string_view passing = {};
};

// The next whole frame that `may_begin` accepts. Asks the line for no byte beyond it, and decides
// by its bytes and by counted silences alone, so that a recorded search replays. Fails: the line's
// own faults; timeout when nothing came; bad_reply when bytes came but no frame; interrupted.
[[nodiscard]] Result<Bytes> FindFrame(Transport& transport, const FrameSearch& search,
                                      const Cancellation& cancellation);

// The first of at most `most_frames` frames that `decode` (bytes -> Result) understands. Damaged
// frames (bad_reply) and passing ones are passed over; when all are, the last one's error is the
// answer.
template <class Decode>
auto FirstDecoded(Transport& transport, const FrameSearch& search, int most_frames,
                  const Cancellation& cancellation, Decode decode) -> decltype(decode(Bytes())) {
  for (int i = 1;; ++i) {
    const auto frame = FindFrame(transport, search, cancellation);
    if (!frame) return tl::unexpected(frame.error());
    auto decoded = decode(*frame);
    const bool passed =
        !decoded && (decoded.error().code == kBadReply || decoded.error().code == search.passing);
    if (!passed || i >= most_frames) return decoded;
  }
}

// Forgets what the line has queued since it was last read, so that the next frame is of now. Waits
// for nothing.
void ForgetQueued(Transport& transport);

// What a cancelled dialogue answers.
[[nodiscard]] tl::unexpected<Error> Interrupted(const std::string& device);

// After these nothing more can be said to the device.
[[nodiscard]] bool IsGone(const Error& error);

}  // namespace lightcal::devices
