// SPDX-License-Identifier: Apache-2.0
#include "batch/find_sessions.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <span>
#include <system_error>

#include "input_files.h"
#include "lightcal/records/session_codec.h"
#include "lightcal_devices/captures/bracket.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSessionFile = "session.toml";

constexpr int kAnyDepth = 1000;

struct FoundBelow {
  std::vector<std::string> sessions;
  std::vector<std::string> hidden;  // folders that this user may not look into
};

// Below a session no other session is looked for: its captures and outputs lie there.
void CollectBelow(const fs::path& directory, int levels, FoundBelow& found) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    std::error_code ignored;
    if (entry.is_directory(ignored) && !entry.is_symlink(ignored)) entries.push_back(entry.path());
  }
  std::ranges::sort(entries);
  for (const fs::path& entry : entries) {
    if (IsSession(entry)) {
      found.sessions.push_back(entry.string());
    } else if (MayNotLookInto(entry.string())) {
      found.hidden.push_back(entry.string());
    } else if (levels > 1) {
      CollectBelow(entry, levels - 1, found);
    }
  }
}

// What lies deeper is not run unasked: a path typed wrong (a whole disk) must not be worked
// through.
Result<std::vector<std::string>> SessionsOf(const std::string& path, bool recursive) {
  if (IsSession(path)) return std::vector<std::string>{path};
  FoundBelow found;
  CollectBelow(path, recursive ? kAnyDepth : 1, found);
  std::vector<std::string> sessions = found.sessions;
  std::ranges::copy(found.hidden, std::back_inserter(sessions));
  std::ranges::sort(sessions);
  if (recursive) return sessions;
  FoundBelow two_levels;
  CollectBelow(path, 2, two_levels);
  std::vector<std::string> deeper = std::move(two_levels.sessions);
  std::erase_if(deeper, [&](const std::string& one) {
    return std::ranges::find(sessions, one) != sessions.end();
  });
  if (deeper.empty()) return sessions;
  constexpr std::size_t kShown = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(deeper.size(), kShown); ++i) {
    list += (list.empty() ? "" : ", ") + deeper[i];
  }
  if (deeper.size() > kShown) list += " and " + std::to_string(deeper.size() - kShown) + " more";
  return Refused("sessions_deeper", path,
                 "has sessions more than one folder below it (" + list +
                     "); name their folder, or pass --recursive to run every one there is");
}

Result<std::vector<std::string>> MatchesOf(const std::string& pattern, bool recursive) {
  const auto matches = devices::ExpandFiles(std::span(&pattern, 1));
  std::vector<std::string> sessions;
  for (const std::string& match : matches.value_or(std::vector<std::string>{})) {
    auto found = SessionsOf(match, recursive);
    if (!found) return found;
    std::ranges::move(*found, std::back_inserter(sessions));
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
    return !seen.insert(WholePath(JournalPath(session))).second;  // of a directory and its toml
  });
}

}  // namespace

bool IsSession(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path / kSessionFile, error) ||
         (path.extension() == ".toml" && fs::is_regular_file(path, error));
}

Result<std::vector<std::string>> FindSessions(const std::vector<std::string>& given,
                                              bool recursive) {
  std::vector<std::string> sessions;
  for (const std::string& path : given) {
    std::error_code error;
    const bool wildcard =
        path.find_first_of("*?[") != std::string::npos && !fs::exists(path, error);
    auto found = wildcard ? MatchesOf(path, recursive) : SessionsOf(path, recursive);
    if (!found) return found;
    if (found->empty()) found->push_back(path);
    std::ranges::move(*found, std::back_inserter(sessions));
  }
  DropRepeated(sessions);
  return sessions;
}

}  // namespace lightcal::app
