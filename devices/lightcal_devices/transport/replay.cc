// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/replay.h"

namespace lightcal::devices {
namespace {

// What the driver asks, in words; what came of it does not matter here.
std::string Spoken(const TapeExchange& exchange) {
  switch (exchange.operation) {
    case TapeOperation::kWrite:
      return "write " + EscapedBytes(exchange.sent);
    case TapeOperation::kRead:
      return "a read";
    case TapeOperation::kControl:
      return exchange.verb + " " + EscapedBytes(exchange.sent);
  }
  return "";
}

bool AskTheSame(const TapeExchange& a, const TapeExchange& b) {
  return a.operation == b.operation && a.verb == b.verb && a.sent == b.sent;
}

}  // namespace

Result<Bytes> ReplayTransport::Play(const TapeExchange& asked, std::size_t max) {
  if (next_ == tape_.exchanges.size()) {
    return Failed(std::string(fault::kTapeEnded), Name(), "the tape ended before " + Spoken(asked));
  }
  const TapeExchange& recorded = tape_.exchanges[next_];
  if (!AskTheSame(recorded, asked)) {
    return Failed(std::string(fault::kTapeMismatch), Name(),
                  "exchange " + std::to_string(next_ + 1) + ": expected " + Spoken(recorded) +
                      ", got " + Spoken(asked));
  }
  if (recorded.received.size() > max) {
    return Failed(std::string(fault::kIo), Name(),
                  "answered " + std::to_string(recorded.received.size()) + " bytes where at most " +
                      std::to_string(max) + " are known");
  }
  ++next_;
  if (!recorded.fault.empty()) {
    return Failed(recorded.fault, Name(), "as recorded on the tape: " + recorded.fault);
  }
  return recorded.received;
}

Result<void> ReplayTransport::Write(std::span<const std::byte> bytes,
                                    std::chrono::milliseconds /*timeout*/) {
  const auto played = Play({TapeOperation::kWrite, 0.0, "", CopyOf(bytes), {}, ""}, 0);
  if (!played) return tl::unexpected(played.error());
  return {};
}

Result<Bytes> ReplayTransport::Read(std::size_t max, std::chrono::milliseconds /*timeout*/) {
  return Play({TapeOperation::kRead, 0.0, "", {}, {}, ""}, max);
}

Result<Bytes> ReplayTransport::Control(std::string_view verb, std::span<const std::byte> bytes,
                                       std::size_t max, std::chrono::milliseconds /*timeout*/) {
  return Play({TapeOperation::kControl, 0.0, std::string(verb), CopyOf(bytes), {}, ""}, max);
}

}  // namespace lightcal::devices
