// SPDX-License-Identifier: Apache-2.0
#include "input_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "lightcal/records/session_codec.h"
#include "lightcal/records/toml_codec.h"
#include "lightcal_devices/disk_sources.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct NotedFiles {
  std::mutex mutex;
  std::set<std::string> paths;
  std::set<std::pair<dev_t, ino_t>> files;
  int answers = 0;  // at work, where a process answers more than once
};

NotedFiles& Noted() {
  static NotedFiles noted;
  return noted;
}

void NoteFrames(const Result<Bracket>& bracket) {
  if (!bracket) return;
  for (const FrameInfo& frame : bracket->frames) NoteInput(frame.file);
}

}  // namespace

std::string WholePath(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  return error ? path : whole.string();
}

void NoteInput(const std::string& path) {
  struct stat status {};
  const bool there = ::stat(path.c_str(), &status) == 0;
  if (there && !S_ISREG(status.st_mode)) return;  // a terminal, a pipe, a folder: none is replaced
  NotedFiles& noted = Noted();
  const std::lock_guard lock(noted.mutex);
  noted.paths.insert(WholePath(path));
  if (there) noted.files.insert({status.st_dev, status.st_ino});
}

InputsOfOneAnswer::InputsOfOneAnswer() {
  NotedFiles& noted = Noted();
  const std::lock_guard lock(noted.mutex);
  ++noted.answers;
}

InputsOfOneAnswer::~InputsOfOneAnswer() {
  NotedFiles& noted = Noted();
  const std::lock_guard lock(noted.mutex);
  if (--noted.answers > 0) return;
  noted.paths.clear();
  noted.files.clear();
}

bool IsInput(const std::string& path) {
  struct stat status {};
  const bool there = ::stat(path.c_str(), &status) == 0;
  NotedFiles& noted = Noted();
  const std::lock_guard lock(noted.mutex);
  return (there && noted.files.contains({status.st_dev, status.st_ino})) ||
         noted.paths.contains(WholePath(path));
}

Sources InputSources() {
  Sources sources = devices::DiskSources();
  const auto note = [](auto& function) {
    function = [read = std::move(function)](const std::string& path) {
      NoteInput(path);
      return read(path);
    };
  };
  note(sources.read_text);
  note(sources.read_spectra);
  note(sources.read_photometric);
  note(sources.read_frame_info);
  note(sources.read_frame);
  note(sources.read_masked_frame);
  sources.open_bracket = [open = std::move(sources.open_bracket)](
                             std::span<const std::string> patterns,
                             const BracketOverrides& overrides) {
    auto bracket = open(patterns, overrides);
    NoteFrames(bracket);
    return bracket;
  };
  return sources;
}

std::string SettingsFolder() {
  if (const char* const settings = std::getenv("XDG_CONFIG_HOME"); settings && *settings) {
    return (fs::path(settings) / "lightcal").string();
  }
  const char* const home = std::getenv("HOME");
  return home && *home ? (fs::path(home) / ".config" / "lightcal").string() : "";
}

Result<FileRoots> RootsOfSession(const std::string& session_path, bool anywhere) {
  FileRoots roots{anywhere, {}};
  if (anywhere) return roots;
  const fs::path own = fs::path(JournalPath(session_path)).parent_path();
  roots.folders.push_back(own.empty() ? "." : own.string());
  const std::string settings = SettingsFolder();
  const fs::path config = fs::path(settings) / "config.toml";
  std::error_code error;
  if (settings.empty() || !fs::exists(config, error)) return roots;
  const auto text = ReadInputFile(config.string());
  if (!text) return tl::unexpected(text.error());
  const auto bad = [&](const std::string& why) {
    return Refused("bad_config", config.string(), why + "; it holds roots = [\"/folder\", ...]");
  };
  const auto document = records::ParseToml(*text);
  if (!document) return bad(document.error().message);
  const records::Node* const named = document->Find("roots");
  if (named == nullptr) return roots;
  for (const records::Node& folder : named->items) {
    if (!fs::path(folder.text).is_absolute()) return bad("a root is a whole path");
    roots.folders.push_back(folder.text);
  }
  return roots;
}

Sources InputSourcesWithin(const FileRoots& roots) {
  Sources sources = InputSources();
  if (roots.anywhere) return sources;
  std::vector<fs::path> folders;
  for (const std::string& folder : roots.folders) folders.emplace_back(WholePath(folder));
  const auto check = [folders = std::move(folders)](const std::string& path) -> Result<void> {
    const fs::path whole = WholePath(path);
    const bool inside = std::ranges::any_of(folders, [&](const fs::path& folder) {
      const fs::path below = whole.lexically_relative(folder);
      return !below.empty() && *below.begin() != "..";
    });
    if (inside) return {};
    return Refused("outside_session", path,
                   "lies outside the session's folder, and a session may come from a stranger: put "
                   "it inside, add --allow-outside, or name its folder in roots of "
                   "~/.config/lightcal/config.toml");
  };
  const auto guard = [&check](auto& function) {
    using Answer = decltype(function(std::string()));
    function = [ask = std::move(function), check](const std::string& path) -> Answer {
      if (auto inside = check(path); !inside) return tl::unexpected(inside.error());
      return ask(path);
    };
  };
  guard(sources.read_text);
  guard(sources.sha256);
  guard(sources.read_spectra);
  guard(sources.read_photometric);
  guard(sources.read_frame_info);
  guard(sources.read_frame);
  guard(sources.read_masked_frame);
  sources.expand_files = [expand = std::move(sources.expand_files),
                          check](std::span<const std::string> patterns) {
    auto files = expand(patterns);
    if (!files) return files;
    for (const std::string& file : *files) {
      if (auto inside = check(file); !inside) {
        return Result<std::vector<std::string>>(tl::unexpected(inside.error()));
      }
    }
    return files;
  };
  // The names first: a frame outside is not opened.
  sources.open_bracket = [open = std::move(sources.open_bracket), expand = sources.expand_files](
                             std::span<const std::string> patterns,
                             const BracketOverrides& overrides) -> Result<Bracket> {
    const auto files = expand(patterns);
    if (!files) return tl::unexpected(files.error());
    return open(patterns, overrides);
  };
  return sources;
}

Result<std::string> ReadInputFile(const std::string& path) {
  return InputSources().read_text(path);
}

}  // namespace lightcal::app
