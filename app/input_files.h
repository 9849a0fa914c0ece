// SPDX-License-Identifier: Apache-2.0
// What this run reads, so that nothing it writes can take the place of it.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/sources.h"

namespace lightcal::app {

// From now on no output of this process replaces this file, whatever --force says. It counts by
// its path and as the file itself, so that a link to it is known too. Threads may note at once.
void NoteInput(const std::string& path);
[[nodiscard]] bool IsInput(const std::string& path);

// devices::DiskSources(), noting every file they are asked for.
[[nodiscard]] Sources InputSources();

// Whole file as bytes, noted. Fails: not_found, unreadable.
[[nodiscard]] Result<std::string> ReadInputFile(const std::string& path);

}  // namespace lightcal::app
