// SPDX-License-Identifier: Apache-2.0
// run.json, beside the outputs of a session that a batch ran: what they were made from, so that
// the next batch can leave them as they are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

inline constexpr std::string_view kRunStampFile = "run.json";
inline constexpr std::string_view kRunStampSchema = "lightcal.run/1";

struct RunStamp {
  std::string generator;           // "lightcal 0.1.0"
  std::string settings;            // SHA-256 of what was asked for
  std::string session;             // NamedFilesHash before the run
  std::vector<InputFile> inputs;   // as in light.json, relative to the session
  std::vector<InputFile> outputs;  // relative to the output directory
};

[[nodiscard]] std::string RunStampToJson(const RunStamp& stamp);
// Refused: bad_run, with what is missing.
[[nodiscard]] Result<RunStamp> RunStampFromJson(std::string_view text, std::string_view where);

// SHA-256 over the names and contents of the files a session itself names: its toml, its journal,
// its shoots and every frame its wildcards match now.   Fails: as LoadSession and ReadInputFile.
[[nodiscard]] Result<std::string> NamedFilesHash(const std::string& session_path);

// Whether `directory` holds, byte for byte, what this program would write there again: a stamp of
// this program with these settings and this session hash whose inputs (relative to
// session_directory) and outputs all still have their hashes.
[[nodiscard]] bool IsUpToDate(const std::string& directory, const std::string& session_directory,
                              const std::string& settings, const std::string& session_hash);

}  // namespace lightcal::app
