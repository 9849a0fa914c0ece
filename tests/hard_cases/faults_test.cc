// SPDX-License-Identifier: Apache-2.0
// A full disk, an output that may not be written, a clock that went back, two programs at once:
// every command ends with a message, the old files stay whole, no temporary stays.
// (Kills: tests/bench/kill_runs.)
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>

#include "hard_case.h"

namespace lightcal::test::hard {
namespace {

namespace fs = std::filesystem;

// Every file at or below a folder with its bytes.
std::map<std::string, std::string> Contents(const std::string& directory) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) contents[entry.path().string()] = ReadFile(entry.path().string());
  }
  return contents;
}

// A session of two readings, its light.json, and the words of each command that writes.
class Writers : public testing::Test {
 protected:
  void SetUp() override {
    folder_.Write("lamp/session.toml",
                  "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n" +
                      std::string(kDarkBulb) +
                      "\n[[reading]]\nlight = \"key\"\ndistance_m = 1.0\n"
                      "illuminance_lx = 100.0\n");
    for (int i = 0; i < 8; ++i) ASSERT_EQ(RunLightcal(Read()).exit_code, 0);
    ASSERT_EQ(RunLightcal({"fit", session(), "-o", folder_.path() + "/in/light.json"}).exit_code,
              0);
  }
  [[nodiscard]] std::string session() const { return folder_.path() + "/lamp"; }
  [[nodiscard]] Words Read() const {
    return {"read", "-s", session(), "--light", "key", "--distance", "1m", "--lux", "100"};
  }
  // By name; all but `read` write to `out`.
  [[nodiscard]] std::map<std::string, Words> WordsTo(const std::string& out) const {
    const std::string frames = SampleData("sessions/grey_card_exr/captures/card_");
    return {{"fit", {"fit", session(), "-o", out + "/light.json"}},
            {"run", {"run", session(), "-o", out}},
            {"export", {"export", folder_.path() + "/in/light.json", "-o", out}},
            {"report", {"report", session(), "-o", out + "/report.html"}},
            {"merge",
             {"merge", frames + "0.exr", frames + "1.exr", "-o", out + "/lum.exr", "--exposures",
              "1/64,1/32", "--f-number", "4", "--iso", "100"}}};
  }

  TempDir folder_;
};

TEST_F(Writers, OnAFullDiskFailAndChangeNothing) {
  const auto on_full_disk = [](Words words) {
    // RLIMIT_FSIZE of 512 bytes stands in for the disk.
    words.insert(words.begin(), {"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"",
                                 LIGHTCAL_BINARY});
    return RunProgram(words);
  };
  for (const auto& [name, words] : WordsTo(folder_.path() + "/out")) {
    ASSERT_EQ(RunLightcal(words).exit_code, 0) << name;
  }
  const auto before = Contents(folder_.path());
  for (const auto& [name, words] : WordsTo(folder_.path() + "/out")) {
    const CliResult result = on_full_disk(words);
    EXPECT_EQ(result.exit_code, 1) << name << result.err;
    EXPECT_NE(result.err.find("lightcal: "), std::string::npos) << name;
    EXPECT_EQ(Contents(folder_.path()), before) << name;
  }
  const CliResult read = on_full_disk(Read());
  EXPECT_EQ(read.exit_code, 1) << read.err;
  EXPECT_EQ(Contents(folder_.path()), before);
}

TEST_F(Writers, WhereNothingMayBeWrittenSaySo) {
  // Root may write to a folder without write permission, but not to /proc.
  const std::string locked = folder_.path() + "/locked";
  fs::create_directory(locked);
  const bool is_root = ::geteuid() == 0;
  ASSERT_EQ(::chmod(locked.c_str(), 0555), 0);
  const std::string out = is_root ? "/proc/lightcal_out" : locked + "/out";
  for (Words words : {WordsTo(out)["fit"], WordsTo(out)["run"], WordsTo(out)["export"],
                      WordsTo(out)["report"], WordsTo(out)["merge"]}) {
    words.emplace_back("--json");
    const CliResult result = RunLightcal(words);
    EXPECT_EQ(result.exit_code, 1) << words[0] << result.err;
    EXPECT_EQ(json::parse(result.out)["error"]["code"], "unwritable") << words[0] << result.out;
  }
}

TEST_F(Writers, AClockThatGoesBackIsNamedAndHarmless) {
  const auto read_at = [&](const char* epoch, const char* distance, const char* lux) {
    Words words = Read();
    words[6] = distance;
    words[8] = lux;
    EXPECT_EQ(RunLightcal(words, "", {std::string("SOURCE_DATE_EPOCH=") + epoch}).exit_code, 0);
  };
  read_at("2000000000", "2m", "25");
  read_at("1000000000", "4m", "6.25");
  const Answer answer = Ask({"fit", session(), "-o", folder_.path() + "/back.json"});
  ExpectWarned(answer, "clock_backwards");
  EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 1.0);
}

TEST_F(Writers, TwoProgramsOnOneSessionWaitForEachOtherOrSaySo) {
  const std::string journal = session() + "/readings.jsonl";
  const std::string before = ReadFile(journal);
  const int held = ::open(journal.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(held, 0);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  Words words = Read();
  words.emplace_back("--json");
  const CliResult locked = RunLightcal(words);
  ::close(held);
  EXPECT_EQ(locked.exit_code, 1) << locked.err;
  const json error = json::parse(locked.out)["error"];
  EXPECT_EQ(error["code"], "session_locked");
  EXPECT_NE(error["message"].get<std::string>().find("another program"), std::string::npos);
  EXPECT_EQ(ReadFile(journal), before);

  // Eight at once: every reading is there, and so is every preset of both runs.
  const CliResult together = RunProgram(
      {"/bin/sh", "-c",
       "for i in 1 2 3 4 5 6 7 8; do \"$0\" read -s \"$1\" --light key --distance 1m --lux 100 & "
       "done; \"$0\" run \"$1\" & \"$0\" run \"$1\" & wait",
       LIGHTCAL_BINARY, session()});
  EXPECT_EQ(together.exit_code, 0) << together.err;
  const std::string after = ReadFile(journal);
  EXPECT_EQ(std::count(after.begin(), after.end(), '\n'),
            std::count(before.begin(), before.end(), '\n') + 8);
  ExpectFiniteFiles(session() + "/out");
  EXPECT_FALSE(json::parse(ReadFile(session() + "/out/light.json"), nullptr, false).is_discarded());
}

}  // namespace
}  // namespace lightcal::test::hard
