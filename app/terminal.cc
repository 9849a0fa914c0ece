// SPDX-License-Identifier: Apache-2.0
#include "terminal.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "interrupt.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"

namespace lightcal::app {
namespace {

// Waits at a terminal for a line. False: a wish to stop came first, or just before; between a look
// at the wish and the wait there is no moment for it to slip through.
bool WaitForLine() {
  sigset_t stops;
  sigset_t former;
  ::sigemptyset(&stops);
  ::sigaddset(&stops, SIGINT);
  ::sigaddset(&stops, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &stops, &former);
  bool ready = false;
  while (!ready && !InterruptGuard::StopRequest().Requested()) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    const int answered = ::ppoll(&input, 1, nullptr, &former);
    ready = answered > 0 || (answered < 0 && errno != EINTR);
  }
  ::pthread_sigmask(SIG_SETMASK, &former, nullptr);
  return ready;
}

}  // namespace

bool CanAsk() { return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1; }

std::optional<std::string> Ask(const std::string& prompt) {
  const std::string shown = Printable(prompt);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  if (::isatty(STDIN_FILENO) == 1 && !WaitForLine()) return std::nullopt;
  std::string line;
  if (!std::getline(std::cin, line)) return std::nullopt;
  return std::string(TrimBlanks(line));
}

}  // namespace lightcal::app
