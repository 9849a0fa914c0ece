// SPDX-License-Identifier: Apache-2.0
// session.toml and readings.jsonl <-> Session. The one place that knows the keys of both files.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct LoadedSession {
  Session session;
  Warnings warnings;  // rejected rows (bad_reading), torn_journal, ...
};

// Loads a session directory (session.toml + readings.jsonl) or a single .toml file (with
// JournalPath's journal beside it, when there is one).
// A bad row of the journal is rejected with the warning bad_reading, whose subject is
// "readings.jsonl:LINE". A last line that stops in the middle is ignored with the warning
// torn_journal; one that only lacks its newline is whole and counts. A cone whose inner_deg exceeds
// its outer_deg is closed to the outer one with the warning cone_order.
// A bad session.toml is refused: bad_session (syntax, NaN, wrong type, distance <= 0),
// unknown_key (names the nearest known key), duplicate_name, unknown_light, unknown_meter;
// the subject is "session.toml:LINE".
// A missing path fails: not_found; one that is no file: unreadable; a folder that this user may not
// look into: no_permission. A session with no light is refused: no_light (unless it calibrates a
// camera). Readings may be none: what that means is the verb's question.
[[nodiscard]] Result<LoadedSession> LoadSession(const std::string& path);

// Where the journal of a session lies: DIR/readings.jsonl of a directory or of its session.toml,
// NAME.readings.jsonl beside any other NAME.toml. The file may not exist yet.
[[nodiscard]] std::string JournalPath(const std::string& session_path);

// Whether permissions hide from this user what lies in a directory, a session.toml or none.
[[nodiscard]] bool MayNotLookInto(const std::string& directory);

// Where brackets are shot to: DIR/captures, or NAME.captures beside any other NAME.toml. What lies
// there with a capture.json (tethered_shoot.h) belongs to the session.
[[nodiscard]] std::string CapturesPath(const std::string& session_path);

// Parses the text of a session.toml. `where` names the file in messages; directory, stem and
// input_files stay empty. Refused as LoadSession says.
[[nodiscard]] Result<Session> ParseSessionToml(std::string_view text, std::string_view where);

// One journal line, without the newline, and back. Keys as in session.toml's [[reading]]; a light
// is not asked for here (one of no session has none). A number that is not finite is written null,
// which reads back as bad_reading. Refused: bad_reading, unknown_key.
[[nodiscard]] records::Node DocumentOf(const Reading& reading);
[[nodiscard]] std::string ReadingToJson(const Reading& reading);
[[nodiscard]] Result<Reading> ReadingFromJson(std::string_view line, std::string_view where);

}  // namespace lightcal
