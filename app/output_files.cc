// SPDX-License-Identifier: Apache-2.0
#include "output_files.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kProvenanceWindowBytes = 4096;

bool CarriesOurProvenance(const std::string& path) {
  std::string window(kProvenanceWindowBytes, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(window.data(), static_cast<std::streamsize>(window.size()));
  window.resize(static_cast<std::size_t>(stream.gcount()));
  if (window.starts_with("{") || window.starts_with("%PDF")) {
    auto contents = ReadWholeFile(path);
    if (!contents) return false;
    window = std::move(*contents);
  }
  return window.find("lightcal") != std::string::npos;
}

tl::unexpected<Error> Unwritable(const std::string& path, int error_number) {
  return Failed("unwritable", path,
                std::string("cannot be written: ") + std::strerror(error_number) +
                    "; choose another -o or make room");
}

Result<void> WriteWhole(const std::string& path, const std::string& contents) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
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

std::string TemporaryName(const std::string& path) {
  const fs::path p(path);
  return (p.parent_path() /
          ("." + p.filename().string() + "." + std::to_string(::getpid()) + ".tmp"))
      .string();
}

// Of a temporary's name: the process that writes it; absent for every other name.
std::optional<int> WriterOfTemporary(const std::string& name) {
  constexpr std::string_view kEnding = ".tmp";
  if (!name.starts_with('.') || !name.ends_with(kEnding)) return std::nullopt;
  const std::string_view stem = std::string_view(name).substr(0, name.size() - kEnding.size());
  const std::string_view digits = stem.substr(stem.rfind('.') + 1);
  int process = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
  const bool whole = error == std::errc() && end == digits.data() + digits.size() && process > 0;
  return whole ? std::optional(process) : std::nullopt;
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
    const auto process = WriterOfTemporary(name);
    if (!process || !IsOver(*process)) continue;
    const std::size_t ending = ("." + std::to_string(*process) + ".tmp").size();
    if (wanted(name.substr(1, name.size() - 1 - ending))) leftovers.push_back(entry.path());
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
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return Unwritable(path, errno);
  const int synced = ::fsync(fd);
  const int error_number = errno;
  ::close(fd);
  if (synced != 0) return Unwritable(path, error_number);
  return {};
}

Result<void> CheckTargets(const std::vector<OutputWriter>& files, bool force) {
  for (const OutputWriter& file : files) {
    std::error_code error;
    if (fs::is_directory(file.path, error)) {
      return Failed("exists", file.path, "is a directory; name a file");
    }
    if (!force && fs::exists(file.path, error) && !CarriesOurProvenance(file.path)) {
      return Failed("exists", file.path,
                    "exists and was not written by lightcal; pass --force to replace it");
    }
  }
  return {};
}

}  // namespace

OutputWriter WriterOf(OutputFile file) {
  std::string path = file.path;
  return {std::move(path), [file = std::move(file)](const std::string& temporary) {
            return WriteWhole(temporary, file.contents);
          }};
}

Result<void> WriteOutputs(const std::vector<OutputFile>& files, bool force) {
  std::vector<OutputWriter> writers;
  writers.reserve(files.size());
  for (const OutputFile& file : files) writers.push_back(WriterOf(file));
  return WriteOutputsWith(writers, force);
}

Result<void> WriteOutputsWith(const std::vector<OutputWriter>& files, bool force) {
  if (auto checked = CheckTargets(files, force); !checked) return checked;
  RemoveLeftoversOf(files);
  std::vector<std::string> temporaries;
  const auto discard = [&] {
    for (const std::string& name : temporaries) ::unlink(name.c_str());
  };
  for (const OutputWriter& file : files) {
    const fs::path directory = fs::path(file.path).parent_path();
    std::error_code error;
    if (!directory.empty()) fs::create_directories(directory, error);
    if (error) {
      discard();
      return Unwritable(directory.string(), error.value());
    }
    temporaries.push_back(TemporaryName(file.path));
    auto written = file.write(temporaries.back());
    if (written) written = Sync(temporaries.back());
    if (!written) {
      discard();
      Error failure = written.error();
      failure.subject = file.path;
      return tl::unexpected(failure);
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (::rename(temporaries[i].c_str(), files[i].path.c_str()) != 0) {
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

Result<std::string> ReadWholeFile(const std::string& path) {
  return devices::DiskSources().read_text(path);
}

std::string GeneratorName() { return "lightcal " LIGHTCAL_VERSION; }

}  // namespace lightcal::app
