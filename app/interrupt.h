// SPDX-License-Identifier: Apache-2.0
// Ctrl-C (and SIGTERM) as a wish to stop, for work that first gives a device back, or as the end
// where the work stands.
#pragma once

#include <array>
#include <csignal>
#include <string>

#include "lightcal_devices/transport/cancellation.h"

namespace lightcal::app {

// Of the two signals, the former ones put back at its end.
class SignalHandlers {
 public:
  explicit SignalHandlers(void (*on_signal)(int));
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> former_{};
};

// While it lives, the first of the two signals is a wish to stop; a second ends the program at
// once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] static const devices::Cancellation& StopRequest();

 private:
  SignalHandlers handlers_;
};

// While it lives, the first of them ends the program where it stands, with exit code 1: for work
// that has nothing to give back and may be long before it could ask. One at a time.
class EndAtOnce {
 public:
  // What is then written to standard output and to stderr.
  EndAtOnce(std::string out, std::string err);

 private:
  SignalHandlers handlers_;
};

}  // namespace lightcal::app
