// SPDX-License-Identifier: Apache-2.0
#include "input_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <mutex>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "lightcal_devices/disk_sources.h"

namespace lightcal::app {
namespace {

struct NotedFiles {
  std::mutex mutex;
  std::set<std::string> paths;
  std::set<std::pair<dev_t, ino_t>> files;
};

NotedFiles& Noted() {
  static NotedFiles noted;
  return noted;
}

std::string WholePath(const std::string& path) {
  std::error_code error;
  const auto whole = std::filesystem::weakly_canonical(path, error);
  return error ? path : whole.string();
}

void NoteFrames(const Result<Bracket>& bracket) {
  if (!bracket) return;
  for (const FrameInfo& frame : bracket->frames) NoteInput(frame.file);
}

}  // namespace

void NoteInput(const std::string& path) {
  struct stat status {};
  const bool there = ::stat(path.c_str(), &status) == 0;
  if (there && !S_ISREG(status.st_mode)) return;  // a terminal, a pipe, a folder: none is replaced
  NotedFiles& noted = Noted();
  const std::lock_guard lock(noted.mutex);
  noted.paths.insert(WholePath(path));
  if (there) noted.files.insert({status.st_dev, status.st_ino});
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

Result<std::string> ReadInputFile(const std::string& path) {
  return InputSources().read_text(path);
}

}  // namespace lightcal::app
