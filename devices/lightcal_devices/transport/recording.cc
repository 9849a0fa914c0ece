// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/recording.h"

#include <cmath>
#include <utility>

namespace lightcal::devices {
Result<void> RecordingTransport::Write(std::span<const std::byte> bytes,
                                       std::chrono::milliseconds timeout) {
  auto done = inner_.Write(bytes, timeout);
  Keep({TapeOperation::kWrite, 0.0, "", CopyOf(bytes), {}, done ? "" : done.error().code});
  return done;
}

Result<Bytes> RecordingTransport::Read(std::size_t max, std::chrono::milliseconds timeout) {
  auto answer = inner_.Read(max, timeout);
  Keep({TapeOperation::kRead,
        0.0,
        "",
        {},
        answer.value_or(Bytes()),
        answer ? "" : answer.error().code});
  return answer;
}

Result<Bytes> RecordingTransport::Control(std::string_view verb, std::span<const std::byte> bytes,
                                          std::size_t max, std::chrono::milliseconds timeout) {
  auto answer = inner_.Control(verb, bytes, max, timeout);
  Keep({TapeOperation::kControl, 0.0, std::string(verb), CopyOf(bytes), answer.value_or(Bytes()),
        answer ? "" : answer.error().code});
  return answer;
}

void RecordingTransport::Keep(TapeExchange exchange) {
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start_;
  exchange.elapsed_ms = std::round(elapsed.count() * 100.0) / 100.0;
  tape_.exchanges.push_back(std::move(exchange));
}

}  // namespace lightcal::devices
