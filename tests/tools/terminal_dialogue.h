// SPDX-License-Identifier: Apache-2.0
// lightcal on a terminal of its own, and the person before it: waits for what the screen says,
// types.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace lightcal::test {

class TerminalDialogue {
 public:
  // Starts the binary with `arguments` in `directory` ("" = here).
  explicit TerminalDialogue(const std::vector<std::string>& arguments,
                            const std::string& directory = "");
  ~TerminalDialogue();
  TerminalDialogue(const TerminalDialogue&) = delete;
  TerminalDialogue& operator=(const TerminalDialogue&) = delete;

  // What came on the screen up to and with `text`, after what was returned before; absent when the
  // program ended first, or said nothing of the kind within ten seconds.
  [[nodiscard]] std::optional<std::string> WaitFor(const std::string& text);
  void Type(const std::string& line);  // and Enter
  void Press(char key);                // '\x03' is Ctrl-C, '\x04' Ctrl-D
  // Reads what is left; the exit code, 128 + signal when killed, as it is after ten seconds.
  int Finish();
  // All that was on the screen, with what was typed.
  [[nodiscard]] const std::string& transcript() const { return screen_; }

 private:
  using Clock = std::chrono::steady_clock;
  // False: the program has ended, or says nothing until then.
  bool Receive(Clock::time_point until);

  int terminal_ = -1;
  pid_t child_ = -1;
  std::string screen_;
  std::size_t seen_ = 0;
};

}  // namespace lightcal::test
