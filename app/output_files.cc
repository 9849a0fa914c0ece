// SPDX-License-Identifier: Apache-2.0
#include "output_files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "input_files.h"
#include "lightcal/core/parallel.h"
#include "provenance_mark.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> Unwritable(const std::string& path, int error_number) {
  return Failed("unwritable", path,
                std::string("cannot be written: ") + std::strerror(error_number) +
                    "; choose another -o or make room");
}

Result<void> WriteWhole(const std::string& path, const std::string& contents) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return Unwritable(path, errno);
  std::size_t written = 0;
  while (written < contents.size()) {
    const ssize_t n = ::write(fd, contents.data() + written, contents.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error_number = errno;
      ::close(fd);
      return Unwritable(path, error_number);
    }
    written += static_cast<std::size_t>(n);
  }
  if (::close(fd) != 0) return Unwritable(path, errno);
  return {};
}

// An empty file of its own beside `path`: never one that is there, never through a link.
Result<std::string> MakeTemporary(const std::string& path) {
  constexpr int kTries = 16;
  const fs::path target(path);
  for (int i = 0; i < kTries; ++i) {
    std::uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) != sizeof random) return Unwritable(path, errno);
    std::array<char, 2 * sizeof random> digits{};
    const char* const end =
        std::to_chars(digits.data(), digits.data() + digits.size(), random, 16).ptr;
    const std::string name =
        "." + target.filename().string() + "." + std::to_string(::getpid()) + "-" +
        std::string(digits.data(), static_cast<std::size_t>(end - digits.data())) + ".tmp";
    std::string temporary = (target.parent_path() / name).string();
    const int fd =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (fd >= 0) {
      ::close(fd);
      return temporary;
    }
    if (errno != EEXIST) return Unwritable(path, errno);
  }
  return Unwritable(path, EEXIST);
}

struct Temporary {
  int process = 0;     // that writes it
  std::string target;  // the file's name that it would take
};

// What a temporary's name (.TARGET.PROCESS-RANDOM.tmp, once without RANDOM) says; absent for every
// other name.
std::optional<Temporary> TemporaryNamed(const std::string& name) {
  constexpr std::string_view kEnding = ".tmp";
  if (!name.starts_with('.') || !name.ends_with(kEnding)) return std::nullopt;
  const std::string stem = name.substr(1, name.size() - 1 - kEnding.size());
  const std::size_t dot = stem.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string_view tail = std::string_view(stem).substr(dot + 1);
  const std::string_view digits = tail.substr(0, tail.find('-'));
  const std::string_view random = tail.substr(std::min(digits.size() + 1, tail.size()));
  int process = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
  const bool whole = error == std::errc() && end == digits.data() + digits.size() && process > 0;
  if (!whole || random.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return std::nullopt;
  }
  return Temporary{process, stem.substr(0, dot)};
}

// Whether a process writes no more: it is not there, its end was not fetched yet (Z), or SIGKILL
// waits for it to come back from the disk.
bool IsOver(int process) {
  if (::kill(process, 0) != 0 && errno == ESRCH) return true;
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  constexpr unsigned long long kKillBit = 1ULL << (SIGKILL - 1);
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("State:") && line.find_first_of("ZX", 6) != std::string::npos) return true;
    if (!line.starts_with("SigPnd:") && !line.starts_with("ShdPnd:")) continue;
    const std::size_t digits = line.find_first_not_of(" \t", 7);
    unsigned long long pending = 0;
    if (digits == std::string::npos) continue;
    std::from_chars(line.data() + digits, line.data() + line.size(), pending, 16);
    if ((pending & kKillBit) != 0) return true;
  }
  return false;
}

// Temporaries in a directory whose writers are over; `wanted` is asked with the target's file name.
template <class Wanted>
void RemoveTemporaries(const fs::path& directory, const Wanted& wanted) {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    const auto temporary = TemporaryNamed(name);
    if (!temporary || !IsOver(temporary->process)) continue;
    if (wanted(temporary->target)) leftovers.push_back(entry.path());
  }
  for (const fs::path& leftover : leftovers) fs::remove(leftover, ignored);
}

// What killed runs left beside these targets.
void RemoveLeftoversOf(const std::vector<OutputWriter>& files) {
  std::map<fs::path, std::set<std::string>> names;  // by directory
  for (const OutputWriter& file : files) {
    const fs::path path(file.path);
    names[path.has_parent_path() ? path.parent_path() : fs::path(".")].insert(
        path.filename().string());
  }
  for (const auto& [directory, targets] : names) {
    RemoveTemporaries(directory,
                      [&targets](const std::string& target) { return targets.contains(target); });
  }
}

// Forces to the disk what another writer left at `path`.
Result<void> Sync(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return Unwritable(path, errno);
  const int synced = ::fsync(fd);
  const int error_number = errno;
  ::close(fd);
  if (synced != 0) return Unwritable(path, error_number);
  return {};
}

// The file's contents on the disk under a temporary's name; nothing where that fails.
Result<std::string> WriteBeside(const OutputWriter& file) {
  const fs::path directory = fs::path(file.path).parent_path();
  std::error_code error;
  if (!directory.empty()) fs::create_directories(directory, error);
  if (error) return Unwritable(directory.string(), error.value());
  auto temporary = MakeTemporary(file.path);
  if (!temporary) return temporary;
  auto written = file.write(*temporary);
  if (written) written = Sync(*temporary);
  if (written) return temporary;
  ::unlink(temporary->c_str());
  Error failure = written.error();
  failure.subject = file.path;
  return tl::unexpected(failure);
}

Result<void> CheckTarget(const std::string& path, std::string_view format, bool format_known,
                         bool force) {
  if (path == "-" || path.starts_with("-/")) {
    return Failed(
        "unwritable", path,
        "is no file: what is written is whole or not there, which a stream cannot promise; "
        "name a file (./- is one), or let --json print the answer");
  }
  std::error_code error;
  if (fs::is_directory(path, error)) return Failed("exists", path, "is a directory; name a file");
  if (IsInput(path)) {
    return Refused("is_input", path,
                   "is read by this very command, and nothing that is read is overwritten; choose "
                   "another name to write to");
  }
  if (format_known) {
    if (auto fits = CheckEnding(path, format); !fits) return fits;
  }
  if (force || !fs::exists(path, error)) return {};
  const std::string there = OwnFormatOfFile(path);
  if (there.empty() || (format_known && there != format)) {
    return Failed("exists", path,
                  std::string("exists and ") +
                      (there.empty() ? "was not written by lightcal"
                                     : "is another kind of file (" + there + ")") +
                      "; choose another name, or pass --force to replace it");
  }
  return {};
}

Result<void> CheckDistinct(const std::vector<std::string>& paths) {
  std::set<std::string> names;
  for (const std::string& path : paths) {
    if (!names.insert(WholePath(path)).second) {
      return Refused("same_output", path,
                     "would be written twice by one command; give each file a name of its own");
    }
  }
  return {};
}

Result<void> CheckTargets(const std::vector<OutputWriter>& files, bool force) {
  std::vector<std::string> paths;
  for (const OutputWriter& file : files) paths.push_back(file.path);
  if (auto distinct = CheckDistinct(paths); !distinct) return distinct;
  for (const OutputWriter& file : files) {
    if (auto free = CheckTarget(file.path, file.format, true, force); !free) return free;
  }
  return {};
}

}  // namespace

OutputWriter WriterOf(OutputFile file) {
  std::string path = file.path;
  std::string format = OwnFormatOf(file.contents);
  return {std::move(path), std::move(format),
          [file = std::move(file)](const std::string& temporary) {
            return WriteWhole(temporary, file.contents);
          }};
}

Result<void> WriteOutputs(const std::vector<OutputFile>& files, bool force) {
  std::vector<OutputWriter> writers(files.size());
  ParallelFor(static_cast<int>(files.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    writers[at] = WriterOf(files[at]);
  });
  return WriteOutputsWith(writers, force);
}

Result<void> CheckOutputs(const std::vector<PlannedOutput>& files, bool force) {
  std::vector<std::string> paths;
  for (const PlannedOutput& file : files) paths.push_back(file.path);
  if (auto distinct = CheckDistinct(paths); !distinct) return distinct;
  for (const PlannedOutput& file : files) {
    if (auto free = CheckTarget(file.path, file.format, !file.format.empty(), force); !free) {
      return free;
    }
  }
  return {};
}

Result<void> WriteOutputsWith(const std::vector<OutputWriter>& files, bool force) {
  if (auto checked = CheckTargets(files, force); !checked) return checked;
  RemoveLeftoversOf(files);
  std::vector<Result<std::string>> temporaries(files.size());
  const auto discard = [&] {
    for (const auto& name : temporaries) {
      if (name && !name->empty()) ::unlink(name->c_str());
    }
  };
  ParallelFor(static_cast<int>(files.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    temporaries[at] = WriteBeside(files[at]);
  });
  const auto failed = std::ranges::find_if(temporaries, [](const auto& one) { return !one; });
  if (failed != temporaries.end()) {
    discard();
    return Propagate(std::move(*failed));
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (::rename(temporaries[i]->c_str(), files[i].path.c_str()) != 0) {
      const int error_number = errno;
      discard();
      return Unwritable(files[i].path, error_number);
    }
  }
  return {};
}

void RemoveLeftovers(const std::string& directory) {
  RemoveTemporaries(directory, [](const std::string&) { return true; });
}

std::string WroteLine(const std::vector<OutputFile>& files, const std::string& directory) {
  if (files.empty()) return "";
  if (files.size() == 1) return "wrote " + files.front().path;
  const auto report = std::ranges::find_if(
      files, [](const OutputFile& file) { return file.path.ends_with("report.html"); });
  return "wrote " + std::to_string(files.size()) + " files to " + directory +
         (report == files.end() ? "" : "; open " + report->path);
}

std::vector<std::string> PathsOf(const std::vector<OutputFile>& files) {
  std::vector<std::string> paths;
  for (const OutputFile& file : files) paths.push_back(file.path);
  return paths;
}

void PlaceUnder(const std::string& directory, std::vector<OutputFile>& files) {
  for (OutputFile& file : files) file.path = (fs::path(directory) / file.path).string();
}

Result<std::string> ReadOutput(const std::string& path) {
  return devices::DiskSources().read_text(path);
}

std::string GeneratorName() { return "lightcal " LIGHTCAL_VERSION; }

}  // namespace lightcal::app
