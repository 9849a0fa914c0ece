// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace lightcal {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() {
    if (fd_ >= 0) close(fd_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

std::shared_ptr<void> Map(int fd, std::size_t size, int protection, int flags) {
  void* const address = mmap(nullptr, size, protection, flags, fd, 0);
  if (address == MAP_FAILED) return nullptr;
  return {address, [size](void* bytes) { munmap(bytes, size); }};
}

}  // namespace

Result<std::shared_ptr<void>> MapScratchFile(std::size_t bytes) {
  const char* const wanted =
      std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  const std::string directory = wanted != nullptr && *wanted != '\0' ? wanted : "/var/tmp";
  std::string name = directory + "/lightcal-XXXXXX";
  const FileDescriptor fd(mkostemp(name.data(), O_CLOEXEC));
  const auto no_space = [&] {
    return Failed("no_scratch_space", directory,
                  std::string("cannot hold ") + std::to_string(bytes >> 20) + " MiB of samples (" +
                      std::strerror(errno) + "); set TMPDIR to a directory with room");
  };
  if (fd.get() < 0) return no_space();
  unlink(name.c_str());
  // Reserved now, so that a full disk is an error here and not a signal later.
  if (const int error = posix_fallocate(fd.get(), 0, static_cast<off_t>(bytes)); error != 0) {
    errno = error;
    return no_space();
  }
  std::shared_ptr<void> mapped = Map(fd.get(), bytes, PROT_READ | PROT_WRITE, MAP_SHARED);
  if (!mapped) return no_space();
  return mapped;
}

Result<MappedFile> MapFile(const std::string& path) {
  const FileDescriptor fd(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat about{};
  if (fd.get() < 0 || fstat(fd.get(), &about) != 0) {
    return Failed(errno == ENOENT ? "not_found" : "unreadable", path, std::strerror(errno));
  }
  if (!S_ISREG(about.st_mode)) return Failed("unreadable", path, "it is not a file");
  if (about.st_size == 0) return Refused("bad_picture", path, "the file is empty");
  const auto size = static_cast<std::size_t>(about.st_size);
  std::shared_ptr<void> mapped = Map(fd.get(), size, PROT_READ, MAP_PRIVATE);
  if (!mapped) return Failed("unreadable", path, std::strerror(errno));
  return MappedFile{std::move(mapped), size};
}

}  // namespace lightcal
