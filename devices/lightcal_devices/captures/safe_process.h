// SPDX-License-Identifier: Apache-2.0
// Work whose crash must not be ours.
#pragma once

#include <functional>

#include "lightcal/core/result.h"

namespace lightcal::devices {

enum class ProcessEnd { kDone, kBroken };

// Runs `work` in a copy of this process and waits for it. Nothing it does to memory is seen here:
// it writes to a file descriptor that both share. It may take two minutes of processor time.
// kBroken: a signal ended it, or it ran out of time.   Fails: no_process.
[[nodiscard]] Result<ProcessEnd> RunInSafeProcess(const std::function<void()>& work);

}  // namespace lightcal::devices
