// SPDX-License-Identifier: Apache-2.0
// The brackets that were shot into a session's captures folder. Internal to the records room.
#pragma once

#include <filesystem>

#include "lightcal/core/result.h"
#include "lightcal/records/session_reader.h"

namespace lightcal::records {

// Adds what the complete capture.json files below `captures` say as further captures, by the name
// of their folders. A [[capture]] of session.toml whose frames lie in the same folder takes the
// place of the shot one. Warns: unfinished_capture, capture_not_described. Refused: as
// TetheredShootFromJson, unknown_light. Fails: unreadable.
[[nodiscard]] Result<void> AddShotCaptures(const std::filesystem::path& captures,
                                           const TextReader& read, LoadedSession& loaded);

}  // namespace lightcal::records
