// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/journal.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>

#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

constexpr std::chrono::milliseconds kLockPatience{2000};
constexpr std::chrono::microseconds kLockPause{500};

class File {
 public:
  explicit File(int fd) : fd_(fd) {}
  ~File() {
    if (fd_ >= 0) ::close(fd_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

// While it lives, a write beyond RLIMIT_FSIZE fails with EFBIG instead of ending the process: the
// thread's SIGXFSZ is held back and, where one came, taken away at the end.
class HoldFileSizeSignal {
 public:
  HoldFileSizeSignal() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &signals_, &former_);
  }
  ~HoldFileSizeSignal() {
    if (sigismember(&former_, SIGXFSZ) == 0) {
      const timespec no_wait{};
      sigtimedwait(&signals_, nullptr, &no_wait);
    }
    pthread_sigmask(SIG_SETMASK, &former_, nullptr);
  }
  HoldFileSizeSignal(const HoldFileSizeSignal&) = delete;
  HoldFileSizeSignal& operator=(const HoldFileSizeSignal&) = delete;

 private:
  sigset_t signals_{};
  sigset_t former_{};
};

tl::unexpected<Error> WriteFailure(const std::string& path, int error) {
  return Failed("journal_write", path,
                "nothing could be written (" + std::system_category().message(error) +
                    "); the journal is as it was");
}

off_t SizeOf(const File& file) {
  struct stat status{};
  return ::fstat(file.get(), &status) == 0 ? status.st_size : -1;
}

// Polls, because a blocking flock cannot time out. A journal that grows meanwhile is no stuck one:
// the patience starts again, so that busy rivals wait for one another instead of failing.
Result<void> Lock(const File& file, const std::string& path) {
  auto deadline = std::chrono::steady_clock::now() + kLockPatience;
  off_t size = SizeOf(file);
  while (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return WriteFailure(path, errno);
    const auto now = std::chrono::steady_clock::now();
    if (const off_t grown = SizeOf(file); grown != size) {
      size = grown;
      deadline = now + kLockPatience;
    }
    if (now >= deadline) {
      return Failed("session_locked", path,
                    "another program has held the journal for 2 s; close it and try again");
    }
    std::this_thread::sleep_for(kLockPause);
  }
  return {};
}

// 0, or the errno of the write that failed.
int WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fdatasync(fd) == 0 ? 0 : errno;
}

bool EndsInsideLine(int fd, off_t size) {
  char last = '\n';
  return size > 0 && ::pread(fd, &last, 1, size - 1) == 1 && last != '\n';
}

int SyncDirectoryOf(const std::string& path) {
  const auto parent = std::filesystem::path(path).parent_path();
  const File directory(
      ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() < 0) return errno;
  return ::fsync(directory.get()) == 0 || errno == EINVAL ? 0 : errno;
}

// The line that LoadSession will take back; a reading it would reject is refused here, while the
// meter is still at its place.
Result<std::string> CheckedLine(const Reading& reading, const std::string& path) {
  std::string line = ReadingToJson(reading);
  auto back = ReadingFromJson(line, path);
  if (!back) return Propagate(std::move(back));
  if (reading.light.empty()) {
    return Refused("bad_reading", path, "light is missing: say which lamp was read");
  }
  return line;
}

Result<void> AppendLines(const std::string& journal_path, const std::string& lines) {
  constexpr mode_t kMode = 0666;
  const File file(
      ::open(journal_path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kMode));
  if (file.get() < 0 && errno == ELOOP) {
    return Failed("journal_write", journal_path,
                  "is a link to another file, which is not written to; put the file itself there");
  }
  if (file.get() < 0) return WriteFailure(journal_path, errno);
  if (auto locked = Lock(file, journal_path); !locked) return locked;
  struct stat status{};
  if (::fstat(file.get(), &status) != 0) return WriteFailure(journal_path, errno);
  if (!S_ISREG(status.st_mode)) return WriteFailure(journal_path, EINVAL);
  const std::string bytes = (EndsInsideLine(file.get(), status.st_size) ? "\n" : "") + lines;
  const HoldFileSizeSignal hold;
  int error = WriteAll(file.get(), bytes);
  if (error == 0 && status.st_size == 0) error = SyncDirectoryOf(journal_path);
  if (error == 0) return {};
  if (::ftruncate(file.get(), status.st_size) != 0) {
    return Failed(
        "journal_write", journal_path,
        "what was to be added could not be written and the journal's last line may be torn; it "
        "will be ignored");
  }
  return WriteFailure(journal_path, error);
}

}  // namespace

Result<void> AppendToJournal(const std::string& journal_path, std::span<const Reading> readings) {
  std::string lines;
  for (const Reading& reading : readings) {
    auto line = CheckedLine(reading, journal_path);
    if (!line) return Propagate(std::move(line));
    lines += *line + "\n";
  }
  return AppendLines(journal_path, lines);
}

Result<void> AppendUndoToJournal(const std::string& journal_path, int line) {
  return AppendLines(journal_path, "{\"undo\":" + std::to_string(line) + "}\n");
}

}  // namespace lightcal
