// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace lightcal::devices {
namespace {

std::shared_ptr<void> Map(int fd, std::size_t size, int protection, int flags) {
  void* const address = mmap(nullptr, size, protection, flags, fd, 0);
  if (address == MAP_FAILED) return nullptr;
  return {address, [size](void* bytes) { munmap(bytes, size); }};
}

std::string ScratchDirectory() {
  const char* const wanted =
      std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return wanted != nullptr && *wanted != '\0' ? wanted : "/var/tmp";
}

tl::unexpected<Error> NoSpace(const std::string& what) {
  return Failed("no_scratch_space", ScratchDirectory(),
                "cannot hold " + what + " (" + std::strerror(errno) +
                    "); set TMPDIR to a directory with room");
}

}  // namespace

Scratch::~Scratch() {
  if (descriptor_ >= 0) close(descriptor_);
}

Result<Scratch> OpenScratch(ScratchPlace place) {
  if (place == ScratchPlace::kMemory) {
    Scratch memory(memfd_create("lightcal", MFD_CLOEXEC));
    if (memory.get() < 0) return NoSpace("samples in memory");
    return memory;
  }
  std::string name = ScratchDirectory() + "/lightcal-XXXXXX";
  Scratch disk(mkostemp(name.data(), O_CLOEXEC));
  if (disk.get() < 0) return NoSpace("a file");
  unlink(name.c_str());
  return disk;
}

Result<std::shared_ptr<void>> MapScratchFile(std::size_t bytes) {
  const auto scratch = OpenScratch(ScratchPlace::kDisk);
  if (!scratch) return tl::unexpected(scratch.error());
  const std::string what = std::to_string(bytes >> 20) + " MiB of samples";
  // Reserved now, so that a full disk is an error here and not a signal later.
  if (const int error = posix_fallocate(scratch->get(), 0, static_cast<off_t>(bytes)); error != 0) {
    errno = error;
    return NoSpace(what);
  }
  std::shared_ptr<void> mapped = Map(scratch->get(), bytes, PROT_READ | PROT_WRITE, MAP_SHARED);
  if (!mapped) return NoSpace(what);
  return mapped;
}

Result<MappedFile> MapWritten(const Scratch& scratch, const std::string& subject) {
  struct stat about {};
  if (fstat(scratch.get(), &about) != 0) return Failed("unreadable", subject, std::strerror(errno));
  if (about.st_size == 0) return MappedFile{};
  const auto size = static_cast<std::size_t>(about.st_size);
  std::shared_ptr<void> mapped = Map(scratch.get(), size, PROT_READ, MAP_SHARED);
  if (!mapped) return Failed("unreadable", subject, std::strerror(errno));
  return MappedFile{std::move(mapped), size};
}

Result<MappedFile> MapFile(const std::string& path) {
  const Scratch fd(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat about {};
  if (fd.get() < 0 || fstat(fd.get(), &about) != 0) {
    return Failed(errno == ENOENT ? "not_found" : "unreadable", path, std::strerror(errno));
  }
  if (S_ISDIR(about.st_mode)) {
    return Failed("unreadable", path, "is a folder; name its files: " + path + "/*");
  }
  if (!S_ISREG(about.st_mode)) return Failed("unreadable", path, "it is not a file");
  if (about.st_size == 0) return Refused("bad_picture", path, "the file is empty");
  const auto size = static_cast<std::size_t>(about.st_size);
  std::shared_ptr<void> mapped = Map(fd.get(), size, PROT_READ, MAP_PRIVATE);
  if (!mapped) return Failed("unreadable", path, std::strerror(errno));
  return MappedFile{std::move(mapped), size};
}

Result<MappedFile> OpenFiles::Map(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto known = mapped_.find(path);
  if (known != mapped_.end()) return known->second;
  auto mapped = MapFile(path);
  if (mapped) mapped_.emplace(path, *mapped);
  return mapped;
}

Result<MappedFile> MapFile(const std::string& path, OpenFiles* files) {
  return files != nullptr ? files->Map(path) : MapFile(path);
}

void ReleasePages(const MappedFile& file) {
  if (file.size == 0) return;
  // Only a hint; nothing was written to a private mapping, so that nothing is lost.
  static_cast<void>(madvise(const_cast<void*>(file.bytes.get()), file.size, MADV_DONTNEED));
}

}  // namespace lightcal::devices
