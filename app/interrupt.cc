// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <cstddef>

namespace lightcal::app {
namespace {

devices::Cancellation& InterruptRequest() {
  static devices::Cancellation request;
  return request;
}

extern "C" void OnInterrupt(int /*signal*/) { InterruptRequest().Request(); }

}  // namespace

InterruptGuard::InterruptGuard() {
  InterruptRequest();  // built here, not inside the handler
  struct sigaction action = {};
  action.sa_handler = OnInterrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &action, &former_[i]);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &former_[i], nullptr);
  }
}

const devices::Cancellation& InterruptGuard::StopRequest() { return InterruptRequest(); }

}  // namespace lightcal::app
