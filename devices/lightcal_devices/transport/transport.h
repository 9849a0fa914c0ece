// SPDX-License-Identifier: Apache-2.0
// The line to an instrument: bytes out, bytes in, and why not. Knows no meter.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::devices {

using Bytes = std::vector<std::byte>;
[[nodiscard]] inline Bytes CopyOf(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

// What can go wrong on a line; Error::code of every transport is one of these words.
namespace fault {
inline constexpr std::string_view kTimeout = "timeout";             // nothing came in time
inline constexpr std::string_view kStalled = "stalled";             // the endpoint refused
inline constexpr std::string_view kUnplugged = "unplugged";         // it was there and is gone
inline constexpr std::string_view kNoDevice = "no_device";          // it is not there
inline constexpr std::string_view kNoPermission = "no_permission";  // it is there, not for us
inline constexpr std::string_view kBusy = "busy";                   // another program holds it
inline constexpr std::string_view kEnded = "ended";  // a program or file is at its end
inline constexpr std::string_view kIo = "io";        // anything else, in words
inline constexpr std::string_view kTapeMismatch = "tape_mismatch";  // a replay was asked otherwise
inline constexpr std::string_view kTapeEnded = "tape_ended";        // a replay was asked for more
}  // namespace fault

class Transport {
 public:
  Transport() = default;
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  // Sends all of `bytes`, or fails.
  virtual Result<void> Write(std::span<const std::byte> bytes,
                             std::chrono::milliseconds timeout) = 0;
  // One message of at most `max` bytes, as the device delimits it (a USB transfer). A shorter
  // message is an answer, not an error: whoever knows the protocol checks the length.
  virtual Result<Bytes> Read(std::size_t max, std::chrono::milliseconds timeout) = 0;
  // What a line offers besides the two streams, by name: "get_feature" of a HID device, "start" of
  // a program; the line's own header lists its verbs. At most `max` bytes come back. A line without
  // the verb fails as io.
  virtual Result<Bytes> Control(std::string_view verb, std::span<const std::byte> bytes,
                                std::size_t max, std::chrono::milliseconds timeout);
  // Whoever reads let time pass on purpose: what came meanwhile and was not asked for is old.
  virtual void Paused() {}
  // For messages: "usb 0a41:7003 at 1-1".
  [[nodiscard]] virtual std::string Name() const = 0;
};

// The bytes of a text, as commands in ASCII are sent.
[[nodiscard]] inline std::span<const std::byte> AsBytes(std::string_view text) {
  return std::as_bytes(std::span(text));
}

}  // namespace lightcal::devices
