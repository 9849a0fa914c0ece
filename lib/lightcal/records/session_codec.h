// SPDX-License-Identifier: Apache-2.0
// session.toml and readings.jsonl <-> Session. The one place that knows the keys of both files.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct LoadedSession {
  Session session;
  Warnings warnings;  // rejected rows (bad_reading), torn_journal, ...
};

// Loads a session directory (session.toml + readings.jsonl) or a single .toml file.
// A bad row of the journal is rejected with a warning; a torn last line is ignored with the warning
// torn_journal. A bad session.toml is refused: bad_session (syntax, NaN, wrong type, distance <= 0),
// unknown_key (names the nearest known key), duplicate_name, unknown_light, unknown_meter.
// A missing path fails: not_found. A session with no light is refused: no_light. Readings may be
// none: what that means is the verb's question.
[[nodiscard]] Result<LoadedSession> LoadSession(const std::string& path);

// Parses the text of a session.toml. `where` names the file in messages.
[[nodiscard]] Result<Session> ParseSessionToml(std::string_view text, std::string_view where);

// One journal line, without the newline, and back. Keys as in session.toml's [[reading]].
[[nodiscard]] std::string ReadingToJson(const Reading& reading);
[[nodiscard]] Result<Reading> ReadingFromJson(std::string_view line, std::string_view where);

}  // namespace lightcal
