// SPDX-License-Identifier: Apache-2.0
// A reading of a session's journal is taken back: which one, and the words that say it.
#pragma once

#include <optional>
#include <string>

#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

struct TakenBack {
  std::string where;  // readings.jsonl:3
  Reading reading;
};

// "key 192.0 lx at 0.5000 m"
[[nodiscard]] std::string SayTakenBack(const Reading& reading);

// The last reading of the journal: of that light where one is named. Refused: nothing_to_undo,
// unknown_light. Fails: as LoadSession and AppendUndoToJournal.
[[nodiscard]] Result<TakenBack> TakeBackLast(const std::string& session_path,
                                             const std::string& light, Console& console);
// The last one that is this reading, whatever others have written since.
[[nodiscard]] Result<TakenBack> TakeBackThis(const std::string& session_path,
                                             const Reading& reading);

}  // namespace lightcal::app
