// SPDX-License-Identifier: Apache-2.0
// Messages cut out of a stream of bytes, over any Transport.
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

// The code of a reply that began and is not what its protocol promises: too short, too long,
// damaged. Asking again may help, which is why it is not a timeout.
inline constexpr std::string_view kBadReply = "bad_reply";

// Holds what a line delivered beyond the message that was asked for. Every wait is for the next
// piece, so that what is asked of the line depends on its bytes alone and never on a clock; a line
// gives at least one byte a piece, so a message of n bytes takes at most n reads.
class StreamReader {
 public:
  // `between`: the longest pause inside a message, which on a serial line is the adapter's.
  explicit StreamReader(Transport& transport,
                        std::chrono::milliseconds between = std::chrono::milliseconds(250))
      : transport_(transport), between_(between) {}

  // Everything up to the end of `terminator`, of at most `max` bytes. `timeout` is the longest wait
  // for the first byte.
  // Fails: the line's own fault; timeout when nothing came; bad_reply when a message broke off or
  // reached `max` without its end (the bytes are then forgotten).
  [[nodiscard]] Result<Bytes> ReadUntil(std::string_view terminator, std::size_t max,
                                        std::chrono::milliseconds timeout);
  // The next `count` bytes. Fails as ReadUntil does.
  [[nodiscard]] Result<Bytes> ReadExactly(std::size_t count, std::chrono::milliseconds timeout);

  // Forgets what is held and reads until the line is silent for `silence`, kLongestDrain reads at
  // most. A fault of the line is left for the next exchange to meet.
  void Drain(std::chrono::milliseconds silence);
  static constexpr int kLongestDrain = 16;

 private:
  // Adds one piece to what is held, of at most `max` bytes.
  Result<void> ReadPiece(std::size_t max, std::chrono::milliseconds timeout);
  Bytes Take(std::size_t count);

  Transport& transport_;
  std::chrono::milliseconds between_;
  Bytes held_;
};

}  // namespace lightcal::devices
