// SPDX-License-Identifier: Apache-2.0
// Files as memory: pages the system may drop and read again.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "lightcal/core/result.h"

namespace lightcal::devices {

// An open file that has no name: in memory, or in $TMPDIR or /var/tmp, from where the system drops
// its pages when memory is short. Closed with the last copy of the owner. Fails: no_scratch_space.
enum class ScratchPlace { kMemory, kDisk };
class Scratch {
 public:
  explicit Scratch(int descriptor) : descriptor_(descriptor) {}
  ~Scratch();
  Scratch(Scratch&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Scratch& operator=(Scratch&&) = delete;
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};
[[nodiscard]] Result<Scratch> OpenScratch(ScratchPlace place);

// `bytes` writable bytes (at least 1) of such a file on disk. Fails: no_scratch_space.
[[nodiscard]] Result<std::shared_ptr<void>> MapScratchFile(std::size_t bytes);

// The bytes of a file, for reading. Fails: not_found, unreadable. Refused: bad_picture (empty).
struct MappedFile {
  std::shared_ptr<const void> bytes;
  std::size_t size = 0;
};
[[nodiscard]] Result<MappedFile> MapFile(const std::string& path);

// Files that stay mapped while it lives: each is opened once, whoever reads it how often. Used by
// several threads at once.
class OpenFiles {
 public:
  // As MapFile.
  [[nodiscard]] Result<MappedFile> Map(const std::string& path);

 private:
  std::mutex mutex_;
  std::map<std::string, MappedFile> mapped_;
};
// One of the open files; opened for this once where there are none.
[[nodiscard]] Result<MappedFile> MapFile(const std::string& path, OpenFiles* files);

// The file's pages leave this process's memory; they come back when they are looked at.
void ReleasePages(const MappedFile& file);

// What was written to a scratch file; `bytes` is null and size 0 where that is nothing.
// Fails: unreadable, about `subject`.
[[nodiscard]] Result<MappedFile> MapWritten(const Scratch& scratch, const std::string& subject);

}  // namespace lightcal::devices
