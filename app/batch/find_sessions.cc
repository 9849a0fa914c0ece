// SPDX-License-Identifier: Apache-2.0
#include "batch/find_sessions.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <span>
#include <system_error>

#include "lightcal/records/session_codec.h"
#include "lightcal_devices/captures/bracket.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSessionFile = "session.toml";

bool IsSession(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path / kSessionFile, error) ||
         (path.extension() == ".toml" && fs::is_regular_file(path, error));
}

// Below a session no other session is looked for: its captures and outputs lie there.
void CollectBelow(const fs::path& directory, std::vector<std::string>& sessions) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    std::error_code ignored;
    if (entry.is_directory(ignored) && !entry.is_symlink(ignored)) entries.push_back(entry.path());
  }
  std::ranges::sort(entries);
  for (const fs::path& entry : entries) {
    if (IsSession(entry)) {
      sessions.push_back(entry.string());
    } else {
      CollectBelow(entry, sessions);
    }
  }
}

std::vector<std::string> SessionsOf(const std::string& path) {
  if (IsSession(path)) return {path};
  std::vector<std::string> sessions;
  CollectBelow(path, sessions);
  return sessions;
}

Result<std::vector<std::string>> MatchesOf(const std::string& pattern) {
  const auto matches = devices::ExpandFiles(std::span(&pattern, 1));
  std::vector<std::string> sessions;
  for (const std::string& match : matches.value_or(std::vector<std::string>{})) {
    std::ranges::move(SessionsOf(match), std::back_inserter(sessions));
  }
  if (sessions.empty()) {
    return Refused("no_sessions", pattern,
                   "matches no session; name directories that hold a session.toml");
  }
  return sessions;
}

void DropRepeated(std::vector<std::string>& sessions) {
  std::set<std::string> seen;
  std::erase_if(sessions, [&](const std::string& session) {
    std::error_code error;
    const std::string journal = JournalPath(session);  // one for the directory and its toml
    const fs::path whole = fs::weakly_canonical(journal, error);
    return !seen.insert(error ? journal : whole.string()).second;
  });
}

}  // namespace

Result<std::vector<std::string>> FindSessions(const std::vector<std::string>& given) {
  std::vector<std::string> sessions;
  for (const std::string& path : given) {
    std::error_code error;
    const bool wildcard =
        path.find_first_of("*?[") != std::string::npos && !fs::exists(path, error);
    auto found = wildcard ? MatchesOf(path) : SessionsOf(path);
    if (!found) return found;
    if (found->empty()) found->push_back(path);
    std::ranges::move(*found, std::back_inserter(sessions));
  }
  DropRepeated(sessions);
  return sessions;
}

}  // namespace lightcal::app
