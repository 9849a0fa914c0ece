// SPDX-License-Identifier: Apache-2.0
// readings.jsonl: append-only, one synced line per reading.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/reading.h"

namespace lightcal {

// Appends one line and returns only after it is on the disk (write of the whole line under an
// exclusive flock, then fdatasync). A torn last line left by a crash is closed with a newline
// first, so that it stays one bad line. Creates the file (and syncs its directory) when absent.
// Safe against other processes that append at the same time.
// Fails: journal_write (no space, read-only, ...), session_locked (another process holds it for 2 s
// and writes nothing); on failure the file keeps its former length. Refused: bad_reading (a reading
// LoadSession would reject: not finite, distance <= 0, no light, nothing measured), before the file
// is touched.
[[nodiscard]] Result<void> AppendToJournal(const std::string& journal_path, const Reading& reading);

}  // namespace lightcal
