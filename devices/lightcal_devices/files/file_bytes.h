// SPDX-License-Identifier: Apache-2.0
// The bytes of a file of limited size, and why there are none: each reader has its own words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lightcal::devices::files {

enum class FileFault : std::uint8_t { kNone, kMissing, kDirectory, kTooLarge, kUnreadable };

struct FileBytes {
  std::string bytes;  // empty where there is a fault
  FileFault fault = FileFault::kNone;
};
// kTooLarge: more than `most` bytes, of which no more are held.
[[nodiscard]] FileBytes ReadFileBytes(const std::string& path, std::size_t most);

}  // namespace lightcal::devices::files
