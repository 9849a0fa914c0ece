// SPDX-License-Identifier: Apache-2.0
// An instrument on a serial line: answers each command as the test says; in memory, or behind a
// pseudo-terminal for the real termios and for programs the test starts.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lightcal_devices/transport/transport.h"
#include "pseudo_terminal.h"

namespace lightcal::test {

// The answer to each command; "" is silence, kPullThePlug the end of the line.
using SerialAnswers = std::function<std::string(const std::string& command)>;
inline const std::string kPullThePlug = "(the plug is pulled)";

class SerialInstrument {
 public:
  // Commands end with `terminator`, which they are given and remembered without.
  SerialInstrument(std::string terminator, SerialAnswers answers)
      : terminator_(std::move(terminator)), answers_(std::move(answers)) {}

  // Takes what was sent; returns what it answers.
  std::string Take(std::string_view bytes);
  [[nodiscard]] bool gone() const { return gone_; }
  [[nodiscard]] std::vector<std::string> commands() const;

 private:
  std::string terminator_;
  SerialAnswers answers_;
  std::string begun_;
  mutable std::mutex guard_;
  std::vector<std::string> commands_;
  std::atomic<bool> gone_{false};
};

// In memory, without waiting.
class SerialFake final : public devices::Transport {
 public:
  SerialFake(std::string terminator, SerialAnswers answers)
      : instrument_(std::move(terminator), std::move(answers)) {}
  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override;
  Result<devices::Bytes> Read(std::size_t max, std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string Name() const override { return "fake serial port"; }
  [[nodiscard]] std::vector<std::string> commands() const { return instrument_.commands(); }

 private:
  SerialInstrument instrument_;
  std::string pending_;
};

// Behind a pseudo-terminal, in a thread of its own.
class SerialStandIn {
 public:
  SerialStandIn(std::string terminator, SerialAnswers answers);
  ~SerialStandIn();
  SerialStandIn(const SerialStandIn&) = delete;
  SerialStandIn& operator=(const SerialStandIn&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::vector<std::string> commands() const { return instrument_.commands(); }

 private:
  void Serve();

  PseudoTerminal terminal_;
  std::string path_;
  SerialInstrument instrument_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace lightcal::test
