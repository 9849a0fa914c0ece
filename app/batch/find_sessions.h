// SPDX-License-Identifier: Apache-2.0
// Which sessions a person means by paths, folders of sessions and wildcards.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::app {

// A directory with a session.toml, or a .toml file.
[[nodiscard]] bool IsSession(const std::filesystem::path& path);

// A session directory or a .toml file stands for itself, a wildcard for what matches it, any other
// directory for every session directory in it, by name; recursive: at any depth. Each session once.
// A path with nothing of that stays as it is, for LoadSession to say what is wrong; so does every
// folder among those that this user may not look into.
// Refused: no_sessions (a wildcard that matches no session), sessions_deeper (not recursive, and a
// folder of the directory holds sessions).
[[nodiscard]] Result<std::vector<std::string>> FindSessions(const std::vector<std::string>& given,
                                                            bool recursive);

}  // namespace lightcal::app
