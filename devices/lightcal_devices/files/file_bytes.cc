// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/file_bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace lightcal::devices::files {

namespace {

constexpr int kPatienceMs = 5000;

// A named pipe, until its writer closes it. One that says nothing for so long is given up: opening
// it as a file is opened would wait for ever.
FileBytes ReadPipe(const std::string& path, std::size_t most) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return {"", FileFault::kUnreadable};
  FileBytes file;
  std::array<char, 1 << 16> chunk{};
  for (;;) {
    pollfd pipe{fd, POLLIN, 0};
    const bool ready = ::poll(&pipe, 1, kPatienceMs) > 0;
    const ssize_t got = ready ? ::read(fd, chunk.data(), chunk.size()) : -1;
    if (ready && got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (got > 0) file.bytes.append(chunk.data(), static_cast<std::size_t>(got));
    if (got < 0) file = {"", FileFault::kUnreadable};
    if (file.bytes.size() > most) file = {"", FileFault::kTooLarge};
    if (got <= 0 || file.fault != FileFault::kNone) break;
  }
  ::close(fd);
  return file;
}

}  // namespace

FileBytes ReadFileBytes(const std::string& path, std::size_t most) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {"", FileFault::kMissing};
  if (std::filesystem::is_directory(path, ignored)) return {"", FileFault::kDirectory};
  if (std::filesystem::is_fifo(path, ignored)) return ReadPipe(path, most);
  std::ifstream stream(path, std::ios::binary);
  FileBytes file;
  std::array<char, 1 << 16> chunk{};
  while (stream.read(chunk.data(), chunk.size()) || stream.gcount() > 0) {
    file.bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (file.bytes.size() > most) return {"", FileFault::kTooLarge};
  }
  if (!stream.eof()) return {"", FileFault::kUnreadable};
  return file;
}

}  // namespace lightcal::devices::files
