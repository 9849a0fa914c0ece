// SPDX-License-Identifier: Apache-2.0
// An instrument that sends whole frames of bytes, asked or not: in memory, or behind a
// pseudo-terminal for the real termios and for programs the test starts.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "lightcal_devices/transport/transport.h"
#include "pseudo_terminal.h"

namespace lightcal::test {

struct Spoken {
  std::string bytes;
  bool pulls_the_plug = false;  // after these bytes
};
// One moment of the instrument: takes from `unread` what it understands and says something, or
// nothing.
using Speak = std::function<Spoken(std::string& unread)>;

// Says these one after the other, then the last one again and again; listens to nothing.
[[nodiscard]] Speak Saying(std::vector<std::string> frames);

// In memory. A read that may wait is a moment; one that may not finds only what was said before.
class StreamFake final : public devices::Transport {
 public:
  explicit StreamFake(Speak speak, std::string queued = "")
      : speak_(std::move(speak)), pending_(std::move(queued)) {}
  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override;
  Result<devices::Bytes> Read(std::size_t max, std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string Name() const override { return "fake serial port"; }

  [[nodiscard]] const std::vector<std::string>& writes() const { return writes_; }
  [[nodiscard]] std::string received() const;  // all writes
  [[nodiscard]] int reads() const { return reads_; }

 private:
  Speak speak_;
  std::string pending_;
  std::string unread_;
  std::vector<std::string> writes_;
  int reads_ = 0;
  bool gone_ = false;
};

// Behind a pseudo-terminal, in a thread of its own: a moment every 5 ms. Silent while no program
// has set the port up.
class StreamStandIn {
 public:
  explicit StreamStandIn(Speak speak);
  ~StreamStandIn();
  StreamStandIn(const StreamStandIn&) = delete;
  StreamStandIn& operator=(const StreamStandIn&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }
  // Waits (5 s at most) until the instrument has received `bytes`; whether it has.
  [[nodiscard]] bool WaitFor(const std::string& bytes) const;
  [[nodiscard]] std::string received() const;

 private:
  void Serve();
  [[nodiscard]] bool IsSetUp() const;

  Speak speak_;
  PseudoTerminal terminal_;
  std::string path_;
  int watch_ = -1;  // on the program's end, to see the port's speed
  unsigned idle_speed_ = 0;
  mutable std::mutex guard_;
  std::string received_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace lightcal::test
