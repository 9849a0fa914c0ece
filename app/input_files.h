// SPDX-License-Identifier: Apache-2.0
// What this run reads, so that nothing it writes can take the place of it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/sources.h"

namespace lightcal::app {

// The path from the root with its links followed; as it is typed where that cannot be told (behind
// a folder that this user may not enter).
[[nodiscard]] std::string WholePath(const std::string& path);

// From now on no output of this process replaces this file, whatever --force says. It counts by
// its path and as the file itself, so that a link to it is known too. Threads may note at once.
void NoteInput(const std::string& path);
[[nodiscard]] bool IsInput(const std::string& path);

// For a process that answers more than once: when the last of these goes, inputs are forgotten.
class InputsOfOneAnswer {
 public:
  InputsOfOneAnswer();
  ~InputsOfOneAnswer();
  InputsOfOneAnswer(const InputsOfOneAnswer&) = delete;
  InputsOfOneAnswer& operator=(const InputsOfOneAnswer&) = delete;
};

// devices::DiskSources(), noting every file they are asked for.
[[nodiscard]] Sources InputSources();

// Where the person keeps meters.toml and config.toml: lightcal in $XDG_CONFIG_HOME (~/.config where
// that is not set); "" = neither it nor HOME is set.
[[nodiscard]] std::string SettingsFolder();

// The folders whose files a session may name: its own, and what the person allows.
struct FileRoots {
  bool anywhere = false;  // --allow-outside
  std::vector<std::string> folders;
};
// The session's own folder and the `roots` of config.toml in the settings folder. Refused:
// bad_config.
[[nodiscard]] Result<FileRoots> RootsOfSession(const std::string& session_path, bool anywhere);
// InputSources() for a session that may be a stranger's: what lies in none of the folders, links
// followed, is refused (outside_session) before it is opened.
[[nodiscard]] Sources InputSourcesWithin(const FileRoots& roots);

// Whole file as bytes, noted. Fails: not_found, unreadable.
[[nodiscard]] Result<std::string> ReadInputFile(const std::string& path);

}  // namespace lightcal::app
