// SPDX-License-Identifier: Apache-2.0
// A serial port in memory: the test holds the instrument's end.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace lightcal::test {

class PseudoTerminal {
 public:
  PseudoTerminal();
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }  // "/dev/pts/3"
  // What the instrument sends.
  void Send(std::string_view bytes) const;
  // What the program sent, up to `count` bytes; waits `wait` for each piece.
  [[nodiscard]] std::string Receive(
      std::size_t count, std::chrono::milliseconds wait = std::chrono::milliseconds(2000)) const;
  void Unplug();

 private:
  int instrument_ = -1;
  int keeper_ = -1;  // keeps the line up while nobody has the port open
  std::string path_;
};

}  // namespace lightcal::test
