// SPDX-License-Identifier: Apache-2.0
#include "serial_instrument.h"

#include <algorithm>

namespace lightcal::test {

std::string SerialInstrument::Take(std::string_view bytes) {
  begun_ += bytes;
  std::string out;
  for (auto end = begun_.find(terminator_); end != std::string::npos && !gone_;
       end = begun_.find(terminator_)) {
    const std::string command = begun_.substr(0, end);
    begun_.erase(0, end + terminator_.size());
    {
      const std::lock_guard lock(guard_);
      commands_.push_back(command);
    }
    const std::string answer = answers_(command);
    if (answer == kPullThePlug) {
      gone_ = true;
    } else {
      out += answer;
    }
  }
  return out;
}

std::vector<std::string> SerialInstrument::commands() const {
  const std::lock_guard lock(guard_);
  return commands_;
}

Result<void> SerialFake::Write(std::span<const std::byte> bytes, std::chrono::milliseconds) {
  if (instrument_.gone()) return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
  std::string text;
  for (const std::byte byte : bytes) text.push_back(static_cast<char>(byte));
  pending_ += instrument_.Take(text);
  return {};
}

Result<devices::Bytes> SerialFake::Read(std::size_t max, std::chrono::milliseconds) {
  if (pending_.empty() && instrument_.gone()) {
    return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
  }
  if (pending_.empty()) return Failed(std::string(devices::fault::kTimeout), Name(), "silent");
  const std::string given = pending_.substr(0, max);
  pending_.erase(0, given.size());
  const auto bytes = devices::AsBytes(given);
  return devices::Bytes(bytes.begin(), bytes.end());
}

SerialStandIn::SerialStandIn(std::string terminator, SerialAnswers answers)
    : path_(terminal_.path()),
      instrument_(std::move(terminator), std::move(answers)),
      thread_([this] { Serve(); }) {}

SerialStandIn::~SerialStandIn() {
  stop_ = true;
  thread_.join();
}

void SerialStandIn::Serve() {
  while (!stop_) {
    const std::string bytes = terminal_.Receive(1, std::chrono::milliseconds(10));
    if (bytes.empty()) continue;
    const std::string answer = instrument_.Take(bytes);
    if (instrument_.gone()) {
      terminal_.Unplug();
      return;
    }
    if (!answer.empty()) terminal_.Send(answer);
  }
}

}  // namespace lightcal::test
