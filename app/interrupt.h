// SPDX-License-Identifier: Apache-2.0
// Ctrl-C (and SIGTERM) as a wish to stop, for work that first gives a device back.
#pragma once

#include <array>
#include <csignal>

#include "lightcal_devices/transport/cancellation.h"

namespace lightcal::app {

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
  static constexpr std::array kSignals = {SIGINT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> former_{};
};

}  // namespace lightcal::app
