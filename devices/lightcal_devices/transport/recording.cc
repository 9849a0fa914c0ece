// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/recording.h"

#include <cmath>

namespace lightcal {

Result<void> RecordingTransport::Write(std::span<const std::byte> bytes,
                                       std::chrono::milliseconds timeout) {
  auto done = inner_.Write(bytes, timeout);
  Note(TapeDirection::kWrite, bytes, "");
  if (!done) Note(TapeDirection::kWriteFault, {}, done.error().code);
  return done;
}

Result<Bytes> RecordingTransport::Read(std::size_t max, std::chrono::milliseconds timeout) {
  auto answer = inner_.Read(max, timeout);
  if (answer) {
    Note(TapeDirection::kRead, *answer, "");
  } else {
    Note(TapeDirection::kReadFault, {}, answer.error().code);
  }
  return answer;
}

void RecordingTransport::Note(TapeDirection direction, std::span<const std::byte> bytes,
                              const std::string& code) {
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start_;
  const double rounded_ms = std::round(elapsed.count() * 100.0) / 100.0;
  tape_.lines.push_back({direction, rounded_ms, Bytes(bytes.begin(), bytes.end()), code});
}

}  // namespace lightcal
