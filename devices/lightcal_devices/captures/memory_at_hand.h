// SPDX-License-Identifier: Apache-2.0
// How much memory a picture may take.
#pragma once

#include <string>

#include "lightcal/core/result.h"

namespace lightcal::devices {

// Bytes that this process may still take without being stopped or slowed to swapping: the least of
// what the kernel calls available (MemAvailable of /proc/meminfo, proc(5)), what the control groups
// above it leave (memory.max less memory.current, cgroups(7), version 2) and what its own limit of
// address space leaves (RLIMIT_AS, getrlimit(2)). Infinite where none of them says.
[[nodiscard]] double MemoryAtHandBytes();

// What to do where a picture's samples take more.
inline constexpr const char* kSamplesNeedMemory =
    "its samples take more memory than is at hand: end what else runs, or raise this process's "
    "limit";

// Refused: too_large, with both figures, where `bytes` of samples are more than that.
[[nodiscard]] Result<void> CheckFitsMemory(double bytes, const std::string& subject);

}  // namespace lightcal::devices
