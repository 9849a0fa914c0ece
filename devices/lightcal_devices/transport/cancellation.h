// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace lightcal::devices {

// A wish to stop, set from a signal handler or another thread and looked at between two exchanges.
// Who cancels waits at most one reply timeout: a dialogue under way first restores its device.
class Cancellation {
 public:
  // Async-signal-safe: the atomic is lock-free.
  void Request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool Requested() const noexcept {
    return requested_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<bool> requested_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace lightcal::devices
