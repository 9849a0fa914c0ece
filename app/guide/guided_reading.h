// SPDX-License-Identifier: Apache-2.0
// `lightcal read` as a walk: says where to put the meter, reads, says how sure the lamp is by now,
// and when it is enough.
#pragma once

#include "commands/read_options.h"
#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// Each reading is in the journal, synced, before the next step is asked for. q or the end of input
// end the walk; Ctrl-C ends it as interrupted, after the meter was given back.
// Refused: unknown_light, unknown_meter, as PlanReadings, and with --strict before a reading that
// was warned of is written. Fails: as ReadingSource::Open and
// AppendToJournal.
[[nodiscard]] Result<void> ReadGuided(const ReadOptions& options, Console& console);

}  // namespace lightcal::app
