// SPDX-License-Identifier: Apache-2.0
// Long series: what stdout acknowledged is in the journal, whenever the program dies, and memory
// does not grow.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "run_cli.h"

namespace lightcal::test {
namespace {

constexpr const char* kSession = "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n";
// Numbers 1, 2, 3, ... without end, as fast as they are read.
constexpr const char* kEndlessMeter = "line:!seq 1000000000";

// lightcal read of a series, with its stdout in our hands.
class SeriesRun {
 public:
  SeriesRun(const std::string& session, const std::string& readings) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDERR_FILENO);
      ::execl(LIGHTCAL_BINARY, "lightcal", "read", "-s", session.c_str(), "--light", "key",
              "--distance", "1m", "--device", kEndlessMeter, "-n", "1", "--repeat",
              readings.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    out_ = ends[0];
  }
  SeriesRun(const SeriesRun&) = delete;
  SeriesRun& operator=(const SeriesRun&) = delete;
  ~SeriesRun() { ::close(out_); }

  // Reads stdout until it holds this many lines or ends.
  void WaitForLines(long lines) {
    while (lines_ < lines && Take()) {
    }
  }
  void Kill() { ::kill(child_, SIGKILL); }
  // Reads the rest and waits for the end.
  void Finish() {
    while (Take()) {
    }
    ::waitpid(child_, &status_, 0);
  }
  // What the running process holds of its own (RssAnon, proc(5)), KiB.
  [[nodiscard]] long AnonymousKib() const {
    std::istringstream lines(ReadFile("/proc/" + std::to_string(child_) + "/status"));
    const std::string key = "RssAnon:";
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(key)) return std::stol(line.substr(key.size()));
    return 0;
  }
  [[nodiscard]] long lines() const { return lines_; }
  [[nodiscard]] bool Killed() const { return WIFSIGNALED(status_); }

 private:
  bool Take() {
    std::array<char, 4096> buffer{};
    const ssize_t got = ::read(out_, buffer.data(), buffer.size());
    if (got <= 0) return false;
    lines_ += std::count(buffer.begin(), buffer.begin() + got, '\n');
    return true;
  }

  pid_t child_ = -1;
  int out_ = -1;
  int status_ = 0;
  long lines_ = 0;  // complete ones
};

// Whole rows of the journal; a torn last line is none.
long RowsIn(const TempDir& dir) {
  std::istringstream lines(ReadFile(dir.path() + "/readings.jsonl"));
  long rows = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto row = nlohmann::json::parse(line, nullptr, false);
    if (row.is_object() && row["illuminance_lx"] == rows + 1) ++rows;
  }
  return rows;
}

TEST(ReadSeries, WhateverStdoutAcknowledgedIsInTheJournalAfterSigkill) {
  std::mt19937 random(20261121);
  std::uniform_int_distribution<long> lines_before(1, 400);
  for (int trial = 0; trial < 12; ++trial) {
    const TempDir dir;
    dir.Write("session.toml", kSession);
    SeriesRun run(dir.path(), "100000");
    run.WaitForLines(lines_before(random));
    run.Kill();
    run.Finish();
    ASSERT_TRUE(run.Killed());
    EXPECT_GT(run.lines(), 0);
    EXPECT_GE(RowsIn(dir), run.lines());
    EXPECT_LE(RowsIn(dir), run.lines() + 1) << "at most the one that was not yet acknowledged";
    const CliResult next =
        RunLightcal({"read", "-s", dir.path(), "--light", "key", "--distance", "1m", "--lux", "5"});
    EXPECT_EQ(next.exit_code, 0) << "the journal takes more: " << next.err;
  }
}

// Of one running process, so that what the loader brings in (some 700 KiB more or less from run to
// run, as the page cache had it) is no part: 10 000 kept readings would be over a megabyte.
TEST(ReadSeries, TenThousandReadingsNeedNoMoreMemoryThanFiveHundred) {
  const TempDir dir;
  dir.Write("session.toml", kSession);
  SeriesRun run(dir.path(), "100000");
  run.WaitForLines(500);
  const long after_500_kib = run.AnonymousKib();
  run.WaitForLines(10000);
  const long after_10000_kib = run.AnonymousKib();
  run.Kill();
  run.Finish();
  ASSERT_TRUE(run.Killed()) << "it was still reading";
  EXPECT_GE(RowsIn(dir), 10000);
  ASSERT_GT(after_500_kib, 0);
  EXPECT_LT(after_10000_kib, after_500_kib + 256) << after_500_kib << " KiB";
}

}  // namespace
}  // namespace lightcal::test
