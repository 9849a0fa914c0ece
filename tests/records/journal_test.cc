// SPDX-License-Identifier: Apache-2.0
// The journal under crashes, rivals and full disks.
#include "lightcal/records/journal.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <thread>

#include "lightcal/records/session_codec.h"
#include "run_cli.h"

namespace lightcal {
namespace {

using test::ReadFile;
using test::TempDir;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

Reading ReadingOf(double lux, std::string device = "") {
  Reading reading;
  reading.light = "key";
  reading.distance = Metres(0.5);
  reading.illuminance = Lux(lux);
  reading.device = std::move(device);
  return reading;
}

// Runs `body` in a child; its exit status, or -signal.
int InChild(const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return lines;
}

TEST(AppendToJournal, CreatesTheFileAndAddsOneLineAReading) {
  const TempDir dir;
  const std::string path = dir.path() + "/readings.jsonl";
  ASSERT_TRUE(AppendToJournal(path, ReadingOf(192.0)));
  ASSERT_TRUE(AppendToJournal(path, ReadingOf(52.0)));
  EXPECT_EQ(ReadFile(path),
            ReadingToJson(ReadingOf(192.0)) + "\n" + ReadingToJson(ReadingOf(52.0)) + "\n");
}

TEST(AppendToJournal, ClosesATornLineFirst) {
  const TempDir dir;
  const std::string path = dir.Write("readings.jsonl", "{\"light\":\"ke");
  ASSERT_TRUE(AppendToJournal(path, ReadingOf(52.0)));
  EXPECT_EQ(ReadFile(path), "{\"light\":\"ke\n" + ReadingToJson(ReadingOf(52.0)) + "\n");
}

TEST(AppendToJournal, RefusesWhatLoadingWouldReject) {
  const TempDir dir;
  const std::string path = dir.path() + "/readings.jsonl";
  Reading nameless = ReadingOf(1.0);
  nameless.light.clear();
  Reading near = ReadingOf(1.0);
  near.distance = Metres(0.0);
  for (const Reading& bad :
       {ReadingOf(std::nan("")), ReadingOf(std::numeric_limits<double>::infinity()),
        ReadingOf(-1.0), nameless, near}) {
    const auto appended = AppendToJournal(path, bad);
    ASSERT_FALSE(appended);
    EXPECT_EQ(appended.error().code, "bad_reading");
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(AppendToJournal, TakesManyReadingsAtOnceOrNone) {
  const TempDir dir;
  const std::string journal = dir.path() + "/readings.jsonl";
  std::vector<Reading> many(100, ReadingOf(192.0));
  ASSERT_TRUE(AppendToJournal(journal, many));
  const std::string kept = ReadFile(journal);
  EXPECT_EQ(Lines(kept).size(), 100U);
  many.back().light.clear();
  EXPECT_EQ(AppendToJournal(journal, many).error().code, "bad_reading");
  EXPECT_EQ(ReadFile(journal), kept) << "the 99 good ones neither";
}

TEST(AppendToJournal, FailsWhereTheFolderIsMissing) {
  const auto appended = AppendToJournal("/nowhere/at/all/readings.jsonl", ReadingOf(1.0));
  ASSERT_FALSE(appended);
  EXPECT_EQ(appended.error().code, "journal_write");
  EXPECT_EQ(appended.error().kind, ErrorKind::kFailed);
  EXPECT_THAT(appended.error().message, HasSubstr("No such file"));
}

TEST(AppendToJournal, FailsWhereItMayNotWriteAndLeavesTheFileAlone) {
  const TempDir dir;
  const std::string old_line = ReadingToJson(ReadingOf(1.0)) + "\n";
  const std::string path = dir.Write("readings.jsonl", old_line);
  std::filesystem::permissions(dir.path(), std::filesystem::perms(0555));
  std::filesystem::permissions(path, std::filesystem::perms(0444));
  constexpr uid_t kNobody = 65534;
  const int status = InChild([&] {
    // Permissions do not bind root.
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return 9;
    const auto appended = AppendToJournal(path, ReadingOf(2.0));
    const auto created = AppendToJournal(dir.path() + "/new.jsonl", ReadingOf(2.0));
    if (appended || created) return 8;
    return appended.error().code == "journal_write" && created.error().code == "journal_write" ? 0
                                                                                               : 7;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(ReadFile(path), old_line);
  EXPECT_FALSE(std::filesystem::exists(dir.path() + "/new.jsonl"));
}

// Every room left between nothing and one byte too little for the line.
TEST(AppendToJournal, KeepsTheFormerLengthWhenTheDiskIsFull) {
  const TempDir dir;
  const std::string old_line = ReadingToJson(ReadingOf(1.0)) + "\n";
  const std::size_t needed = ReadingToJson(ReadingOf(2.0)).size() + 1;
  for (std::size_t room = 0; room < needed; room += 7) {
    const std::string path = dir.Write("readings.jsonl", old_line);
    const int status = InChild([&] {
      const rlimit limit{old_line.size() + room, old_line.size() + room};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      const auto appended = AppendToJournal(path, ReadingOf(2.0));
      return !appended && appended.error().code == "journal_write" ? 0 : 1;
    });
    EXPECT_EQ(status, 0) << room;
    EXPECT_EQ(ReadFile(path), old_line) << room;
  }
}

TEST(AppendToJournal, FullDiskLeavesTheProcessesSignalsAsTheyWere) {
  const TempDir dir;
  const std::string path = dir.path() + "/readings.jsonl";
  const int status = InChild([&] {
    const rlimit limit{4, 4};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    if (AppendToJournal(path, ReadingOf(2.0))) return 1;
    sigset_t blocked;
    ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    sigset_t pending;
    ::sigpending(&pending);
    return ::sigismember(&blocked, SIGXFSZ) + 2 * ::sigismember(&pending, SIGXFSZ);
  });
  EXPECT_EQ(status, 0);
}

TEST(AppendToJournal, TwoWritersLoseAndMixNoLine) {
  constexpr int kEach = 500;
  const TempDir dir;
  const std::string path = dir.path() + "/readings.jsonl";
  const auto append_all = [&](const std::string& device) {
    for (int i = 0; i < kEach; ++i) {
      if (!AppendToJournal(path, ReadingOf(i, device))) return 1;
    }
    return 0;
  };
  const pid_t rival = ::fork();
  if (rival == 0) ::_exit(append_all("second"));
  EXPECT_EQ(append_all("first"), 0);
  int status = -1;
  ::waitpid(rival, &status, 0);
  EXPECT_EQ(status, 0);
  std::set<std::pair<std::string, double>> seen;
  const auto lines = Lines(ReadFile(path));
  for (const std::string& line : lines) {
    const auto reading = ReadingFromJson(line, "line");
    ASSERT_TRUE(reading) << line;
    seen.insert({reading->device, reading->illuminance->value()});
  }
  EXPECT_EQ(lines.size(), 2U * kEach);
  EXPECT_EQ(seen.size(), 2U * kEach);
}

TEST(AppendToJournal, KilledWriterLeavesWholeLinesAndAtMostOneTorn) {
  const TempDir dir;
  const std::string path = dir.path() + "/readings.jsonl";
  dir.Write("session.toml", "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n");
  for (int round = 0; round < 10; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int i = 0;; ++i) (void)AppendToJournal(path, ReadingOf(i, "doomed"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 3 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_TRUE(AppendToJournal(path, ReadingOf(round, "after")));
    const auto loaded = LoadSession(dir.path());
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->session.readings.back().reading.device, "after");
    EXPECT_LE(loaded->warnings.size(), static_cast<std::size_t>(round) + 1);
    const std::size_t lines = Lines(ReadFile(path)).size();
    EXPECT_EQ(loaded->session.readings.size() + loaded->warnings.size(), lines);
  }
  EXPECT_THAT(ReadFile(path), EndsWith("\n"));
}

TEST(AppendToJournal, GivesUpOnALockThatAnotherHolds) {
  const TempDir dir;
  const std::string path = dir.Write("readings.jsonl", "");
  const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(fd, LOCK_EX), 0);
  const auto begin = std::chrono::steady_clock::now();
  const auto appended = AppendToJournal(path, ReadingOf(1.0));
  const auto waited = std::chrono::steady_clock::now() - begin;
  ::close(fd);
  ASSERT_FALSE(appended);
  EXPECT_EQ(appended.error().code, "session_locked");
  EXPECT_GE(waited, std::chrono::milliseconds(1900));
  EXPECT_EQ(ReadFile(path), "");
  EXPECT_TRUE(AppendToJournal(path, ReadingOf(1.0)));
}

TEST(AppendToJournal, WritesNothingIntoWhatIsNoFile) {
  const TempDir dir;
  const auto folder = AppendToJournal(dir.path(), ReadingOf(1.0));
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, "journal_write");
  const auto device = AppendToJournal("/dev/null", ReadingOf(1.0));
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().code, "journal_write");
}

}  // namespace
}  // namespace lightcal
