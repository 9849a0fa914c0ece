// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/replay.h"

#include <algorithm>

namespace lightcal {
namespace {

std::string Spoken(TapeDirection direction, std::span<const std::byte> bytes) {
  switch (direction) {
    case TapeDirection::kWrite:
      return "write " + EscapedBytes(bytes);
    case TapeDirection::kRead:
    case TapeDirection::kReadFault:
      return "a read";
    case TapeDirection::kWriteFault:
      return "a failed write";
  }
  return "";
}

}  // namespace

Result<const TapeLine*> ReplayTransport::Next(const std::string& asked) const {
  if (next_ < tape_.lines.size()) return &tape_.lines[next_];
  return Failed(std::string(fault::kTapeEnded), Name(), "the tape ended before " + asked);
}

tl::unexpected<Error> ReplayTransport::Mismatch(const TapeLine& line,
                                                const std::string& asked) const {
  return Failed(std::string(fault::kTapeMismatch), Name(),
                "exchange " + std::to_string(next_ + 1) + ": expected " +
                    Spoken(line.direction, line.bytes) + ", got " + asked);
}

tl::unexpected<Error> ReplayTransport::RecordedFault() {
  const std::string& code = tape_.lines[next_++].code;
  return Failed(code, Name(), "as recorded on the tape: " + code);
}

Result<void> ReplayTransport::Write(std::span<const std::byte> bytes,
                                    std::chrono::milliseconds /*timeout*/) {
  const std::string asked = Spoken(TapeDirection::kWrite, bytes);
  const auto line = Next(asked);
  if (!line) return tl::unexpected(line.error());
  if ((*line)->direction != TapeDirection::kWrite || !std::ranges::equal((*line)->bytes, bytes)) {
    return Mismatch(**line, asked);
  }
  ++next_;
  const bool failed_then =
      next_ < tape_.lines.size() && tape_.lines[next_].direction == TapeDirection::kWriteFault;
  if (failed_then) return RecordedFault();
  return {};
}

Result<Bytes> ReplayTransport::Read(std::size_t max, std::chrono::milliseconds /*timeout*/) {
  const std::string asked = Spoken(TapeDirection::kRead, {});
  const auto line = Next(asked);
  if (!line) return tl::unexpected(line.error());
  if ((*line)->direction == TapeDirection::kReadFault) return RecordedFault();
  if ((*line)->direction != TapeDirection::kRead) return Mismatch(**line, asked);
  if ((*line)->bytes.size() > max) {
    return Failed(std::string(fault::kIo), Name(),
                  "answered " + std::to_string((*line)->bytes.size()) + " bytes where at most " +
                      std::to_string(max) + " are known");
  }
  ++next_;
  return (*line)->bytes;
}

}  // namespace lightcal
