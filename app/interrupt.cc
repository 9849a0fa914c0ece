// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <unistd.h>

#include <cstddef>
#include <string>
#include <utility>

namespace lightcal::app {
namespace {

devices::Cancellation& InterruptRequest() {
  static devices::Cancellation request;
  return request;
}

extern "C" void OnInterrupt(int /*signal*/) { InterruptRequest().Request(); }

// Of the one EndAtOnce.
struct LastWords {
  std::string out, err;
};
LastWords& TheLastWords() {
  static LastWords words;
  return words;
}

// Nothing but what a handler may call.
extern "C" void OnEnd(int /*signal*/) {
  const LastWords& words = TheLastWords();
  const auto said = ::write(STDOUT_FILENO, words.out.data(), words.out.size()) +
                    ::write(STDERR_FILENO, words.err.data(), words.err.size());
  static_cast<void>(said);
  ::_exit(1);
}

}  // namespace

SignalHandlers::SignalHandlers(void (*on_signal)(int)) {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &action, &former_[i]);
  }
}

SignalHandlers::~SignalHandlers() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &former_[i], nullptr);
  }
}

// The request is built here, not inside the handler.
InterruptGuard::InterruptGuard() : handlers_((InterruptRequest(), OnInterrupt)) {}

InterruptGuard::~InterruptGuard() = default;

EndAtOnce::EndAtOnce(std::string out, std::string err)
    : handlers_((TheLastWords() = {std::move(out), std::move(err)}, OnEnd)) {}

const devices::Cancellation& InterruptGuard::StopRequest() { return InterruptRequest(); }

}  // namespace lightcal::app
