// SPDX-License-Identifier: Apache-2.0
// Files as memory: pages the system may drop and read again.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "lightcal/core/result.h"

namespace lightcal {

// `bytes` writable bytes (at least 1) in a file that has no name any more, in $TMPDIR or /var/tmp;
// released with the last copy. Fails: no_scratch_space.
[[nodiscard]] Result<std::shared_ptr<void>> MapScratchFile(std::size_t bytes);

// The bytes of a file, for reading. Fails: not_found, unreadable. Refused: bad_picture (empty).
struct MappedFile {
  std::shared_ptr<const void> bytes;
  std::size_t size = 0;
};
[[nodiscard]] Result<MappedFile> MapFile(const std::string& path);

}  // namespace lightcal
