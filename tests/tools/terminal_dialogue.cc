// SPDX-License-Identifier: Apache-2.0
#include "terminal_dialogue.h"

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace lightcal::test {
namespace {

constexpr std::chrono::seconds kPatience{10};

}  // namespace

TerminalDialogue::TerminalDialogue(const std::vector<std::string>& arguments,
                                   const std::string& directory) {
  winsize size{};
  size.ws_col = 100;
  size.ws_row = 40;
  child_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
  if (child_ < 0) throw std::runtime_error("forkpty");
  if (child_ > 0) return;
  if (!directory.empty() && ::chdir(directory.c_str()) != 0) ::_exit(126);
  ::setenv("TERM", "xterm", 1);
  std::vector<char*> argv = {const_cast<char*>("lightcal")};
  for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execv(LIGHTCAL_BINARY, argv.data());
  ::_exit(127);
}

TerminalDialogue::~TerminalDialogue() {
  if (terminal_ >= 0) ::close(terminal_);
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
}

bool TerminalDialogue::Receive(Clock::time_point until) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
  pollfd line{terminal_, POLLIN, 0};
  if (left.count() <= 0 || ::poll(&line, 1, static_cast<int>(left.count())) <= 0) return false;
  std::array<char, 4096> buffer{};
  const ssize_t got = ::read(terminal_, buffer.data(), buffer.size());
  if (got <= 0) return false;
  screen_.append(buffer.data(), static_cast<std::size_t>(got));
  return true;
}

std::optional<std::string> TerminalDialogue::WaitFor(const std::string& text) {
  const auto until = Clock::now() + kPatience;
  while (true) {
    const auto at = screen_.find(text, seen_);
    if (at != std::string::npos) {
      std::string fresh = screen_.substr(seen_, at + text.size() - seen_);
      seen_ = at + text.size();
      return fresh;
    }
    if (!Receive(until)) return std::nullopt;
  }
}

void TerminalDialogue::Type(const std::string& line) {
  const std::string keys = line + "\n";
  if (::write(terminal_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size())) {
    throw std::runtime_error("the terminal took less than all keys");
  }
}

void TerminalDialogue::Press(char key) {
  if (::write(terminal_, &key, 1) != 1) throw std::runtime_error("the terminal took no key");
}

int TerminalDialogue::Finish() {
  const auto until = Clock::now() + kPatience;
  while (Receive(until)) {
  }
  if (Clock::now() >= until) ::kill(child_, SIGKILL);
  int status = 0;
  ::waitpid(child_, &status, 0);
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace lightcal::test
