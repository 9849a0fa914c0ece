// SPDX-License-Identifier: Apache-2.0
// Any file lightcal writes or reads, read by its own reader: what it is, and whether it is whole.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"

namespace lightcal::app {

struct FileVerdict {
  std::string path;
  std::string format;          // "light", "session", "IES" ...; "" = not recognised
  std::string version;         // "lightcal.light/1", "LM-63-2002"; "" = the format has none
  std::string holds;           // "3 lights", where it was read
  Warnings warnings;           // what the reader put right or passed over
  std::optional<Error> error;  // what is wrong, where, and what to do
  bool checked = true;         // false: lightcal wrote it and has no reader for it
};

// Formats are told apart by content, by name only where content cannot tell (.toml, .jsonl, .ldt
// and engine files). A session directory is checked with its journal, and that every file it names
// is there. An error's code is the reader's own; besides: not_found, unreadable, unknown_format,
// unknown_version, bad_json, too_large (over 256 MiB).
[[nodiscard]] FileVerdict ValidateFile(const std::string& path);

}  // namespace lightcal::app
