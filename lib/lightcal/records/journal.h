// SPDX-License-Identifier: Apache-2.0
// readings.jsonl: append-only, one synced line per reading.
#pragma once

#include <span>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/reading.h"

namespace lightcal {

// Appends one line a reading and returns only after all are on the disk (one write of whole lines
// under an exclusive flock, then one fdatasync). A crash on the way leaves the first of them and at
// most one torn line. A torn last line left by a crash is closed with a newline
// first, so that it stays one bad line. Creates the file (and syncs its directory) when absent.
// Safe against other processes that append at the same time.
// Fails: journal_write (no space, read-only, ...), session_locked (another process holds it for 2 s
// and writes nothing); on failure the file keeps its former length. Refused: bad_reading (a reading
// LoadSession would reject: not finite, distance <= 0, no light, nothing measured), before the file
// is touched.
[[nodiscard]] Result<void> AppendToJournal(const std::string& journal_path,
                                           std::span<const Reading> readings);
[[nodiscard]] inline Result<void> AppendToJournal(const std::string& journal_path,
                                                  const Reading& reading) {
  return AppendToJournal(journal_path, std::span(&reading, 1));
}

// A reading typed wrong is taken back by a line of its own, {"undo":3}: the reading of the
// journal's line 3, as others may have written since; {"undo":true} takes back the last reading
// above it that no other such line did. What was written stays, as in any laboratory's book. Fails
// as AppendToJournal.
[[nodiscard]] Result<void> AppendUndoToJournal(const std::string& journal_path, int line);

}  // namespace lightcal
