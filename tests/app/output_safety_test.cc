// SPDX-License-Identifier: Apache-2.0
// Nothing a person made is ever replaced: not what a command reads, not a session, not a file that
// only speaks of lightcal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kSession =
    "# lightcal session, written by lightcal new and edited since\n"
    "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
    "[[reading]]\nlight = \"key\"\ndistance_m = 0.5\nilluminance_lx = 203.0\n"
    "[[reading]]\nlight = \"key\"\ndistance_m = 1.0\nilluminance_lx = 58.0\n";
constexpr const char* kJournal = "{\"light\":\"key\",\"distance_m\":2.0,\"illuminance_lx\":20.0}\n";

class OutputSafety : public ::testing::Test {
 protected:
  std::string InFolder(const std::string& name) const { return folder_.path() + "/" + name; }

  // The command is refused, and no file of the folder has changed nor joined.
  void ExpectNothingChanged(const std::vector<std::string>& command, int exit_code) {
    SCOPED_TRACE(testing::PrintToString(command));
    const auto before = Contents();
    const CliResult result = RunLightcal(command);
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    EXPECT_EQ(Contents(), before);
  }

  std::map<std::string, std::string> Contents() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      if (entry.is_regular_file())
        contents[entry.path().string()] = ReadFile(entry.path().string());
    }
    return contents;
  }

  TempDir folder_;
  std::string session_ = folder_.path() + "/s";
  std::string toml_ = folder_.Write("s/session.toml", kSession);
  std::string journal_ = folder_.Write("s/readings.jsonl", kJournal);
};

TEST_F(OutputSafety, ADashIsNoFile) {
  ExpectNothingChanged({"page", "-o", "-"}, 1);
  ExpectNothingChanged({"run", session_, "-o", "-"}, 1);
  EXPECT_FALSE(fs::exists("-"));
}

TEST_F(OutputSafety, WhatACommandReadsIsNeverOverwrittenWhateverForceSays) {
  for (const std::string& target : {toml_, journal_}) {
    for (const char* force : {"", "--force"}) {
      const auto with = [&](std::vector<std::string> command) {
        if (*force != '\0') command.emplace_back(force);
        ExpectNothingChanged(command, 3);
      };
      with({"fit", session_, "-o", target});
      with({"report", session_, "-o", target});
    }
    ExpectNothingChanged({"run", session_, "--summary", target}, 3);
  }
  // By another name, and through links of both kinds.
  fs::create_symlink(toml_, InFolder("soft"));
  fs::create_hard_link(toml_, InFolder("hard"));
  ExpectNothingChanged({"fit", session_, "-o", session_ + "/../s/session.toml", "--force"}, 3);
  ExpectNothingChanged({"fit", session_, "-o", InFolder("soft"), "--force"}, 3);
  ExpectNothingChanged({"fit", session_, "-o", InFolder("hard"), "--force"}, 3);
}

// Longer than what the C library holds back: the loss comes in the middle.
TEST_F(OutputSafety, WhatStandardOutputCannotTakeIsSaidWhateverItsLength) {
  for (std::vector<std::string> words :
       std::vector<std::vector<std::string>>{{"fit", session_, "--json", "-q"},
                                             {"explain", session_, "--json"},
                                             {"quick", "192lx@0.5m", "--json", "-q"},
                                             {"man"},
                                             {"completion", "bash"},
                                             {"quick", "--help"},
                                             {"--help"},
                                             {"--version"}}) {
    SCOPED_TRACE(testing::PrintToString(words));
    words.insert(words.begin(),
                 {"/bin/sh", "-c", "exec \"$0\" \"$@\" > /dev/full", LIGHTCAL_BINARY});
    const CliResult result = RunProgram(words);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("standard output cannot be written"));
  }
}

TEST_F(OutputSafety, AFileAtTheLimitOfItsSizeIsAWriteThatFails) {
  const std::vector<std::string> words = {"/bin/sh",
                                          "-c",
                                          "ulimit -f 1; exec \"$0\" \"$@\"",
                                          LIGHTCAL_BINARY,
                                          "fit",
                                          session_,
                                          "-o",
                                          InFolder("light.json")};
  const auto before = Contents();
  const CliResult result = RunProgram(words);
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  EXPECT_THAT(result.err, HasSubstr("File too large"));
  EXPECT_EQ(Contents(), before);
}

TEST_F(OutputSafety, InputsOfOtherCommandsToo) {
  ASSERT_EQ(RunLightcal({"fit", session_, "-o", InFolder("light.json")}).exit_code, 0);
  ExpectNothingChanged({"report", InFolder("light.json"), "-o", InFolder("light.json"), "--force"},
                       3);
  const std::string ldt = InFolder("lamp.ldt");
  fs::copy_file(SampleData("photometric/sample1.ldt"), ldt);
  ExpectNothingChanged({"photometric", ldt, "--to", "ldt", "-o", ldt, "--force"}, 3);
  const std::string tape = InFolder("a.tape");
  fs::copy_file(SampleData("tapes/gm1020_123lx.tape"), tape);
  ExpectNothingChanged({"read", "--once", "--replay", tape, "--record", tape}, 3);
  const std::string frame = InFolder("frame.exr");
  const std::string bracket = SampleData("pictures/exr");
  for (const auto& entry : fs::directory_iterator(bracket)) {
    if (entry.path().extension() != ".exr") continue;
    fs::copy_file(entry.path(), frame, fs::copy_options::overwrite_existing);
  }
  ASSERT_TRUE(fs::exists(frame));
  ExpectNothingChanged(
      {"merge", frame, "-o", frame, "--force", "--exposures", "1/10", "--f-number", "4"}, 3);
}

TEST_F(OutputSafety, TheWordLightcalIsNoMarkAndAnotherFormatOfOursIsNoTarget) {
  const std::string notes = folder_.Write("notes.json", "{\"about\": \"my lightcal sessions\"}\n");
  const std::string script = folder_.Write("mine.svg", "<svg>\n<!-- for lightcal -->\n</svg>\n");
  ExpectNothingChanged({"fit", session_, "-o", notes}, 1);
  ExpectNothingChanged({"explain", session_, "--plot", script}, 1);
  // Another's session.toml, which has the word in its first line.
  const std::string other = folder_.Write("t/session.toml", kSession);
  ExpectNothingChanged({"fit", session_, "-o", other, "--force"}, 3);
  const std::string tape = InFolder("a.tape");
  fs::copy_file(SampleData("tapes/gm1020_123lx.tape"), tape);
  ExpectNothingChanged({"fit", session_, "-o", tape}, 1);
  EXPECT_EQ(RunLightcal({"fit", session_, "-o", notes, "--force"}).exit_code, 0);
  EXPECT_EQ(LightcalJson("fit", {session_, "-o", notes}).at("lights").size(), 1U);
}

TEST_F(OutputSafety, EveryFileOfARunIsKnownAsOursAndReplaced) {
  const std::string out = session_ + "/out";
  ASSERT_EQ(RunLightcal({"run", session_, "--resume"}).exit_code, 0);
  const auto before = Contents();
  EXPECT_GT(before.size(), 15U);
  for (const auto& entry : fs::directory_iterator(out)) {
    fs::last_write_time(entry.path(), fs::file_time_type());
  }
  const CliResult again = RunLightcal({"run", session_, "--jobs", "1"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(Contents(), before);
  for (const auto& entry : fs::directory_iterator(out)) {
    EXPECT_NE(fs::last_write_time(entry.path()), fs::file_time_type()) << entry.path();
  }
}

TEST_F(OutputSafety, PicturesTablesAndPhotometryOfOursAreReplaced) {
  for (const char* name : {"map.png", "map.svg", "map.exr", "map.csv"}) {
    const std::vector<std::string> map = {"simulate", session_, "--position", "0,0,2",
                                          "--plane",  "floor",  "--room",     "4,4,2.5",
                                          "--grid",   "5",      "-o",         InFolder(name)};
    ASSERT_EQ(RunLightcal(map).exit_code, 0) << name;
    EXPECT_EQ(RunLightcal(map).exit_code, 0) << name;
  }
  for (const char* to : {"ies", "ldt"}) {
    const std::vector<std::string> convert = {"photometric", SampleData("photometric/sample1.ldt"),
                                              "--to",        to,
                                              "-o",          InFolder(std::string("lamp.") + to)};
    ASSERT_EQ(RunLightcal(convert).exit_code, 0);
    EXPECT_EQ(RunLightcal(convert).exit_code, 0);
  }
}

TEST_F(OutputSafety, ANameThatEndsAsAnotherFormatOrIsTakenTwiceIsRefused) {
  const std::string ldt = SampleData("photometric/sample1.ldt");
  ExpectNothingChanged({"photometric", ldt, "--to", "ies", "-o", InFolder("x.ldt")}, 3);
  ExpectNothingChanged({"fit", session_, "-o", InFolder("light.toml")}, 3);
  const std::string frames = SampleData("sessions/grey_card_exr/captures/*.exr");
  ExpectNothingChanged({"merge", frames, "-o", InFolder("out.png")}, 3);
  ExpectNothingChanged({"merge", frames, "-o", InFolder("a.exr"), "--sigma", InFolder("a.exr")}, 3);
  ExpectNothingChanged({"merge", frames, "-o", InFolder("a.exr"), "--sigma", InFolder("./a.exr")},
                       3);
  // Which name fits is said.
  const auto table = RunLightcal({"run", session_, "--summary", InFolder("farm.csv")});
  EXPECT_EQ(table.exit_code, 3);
  EXPECT_THAT(table.err, HasSubstr("ends in .json"));
}

TEST_F(OutputSafety, ALinkThatWaitsForAPredictableNameIsNotFollowed) {
  const std::string precious = folder_.Write("precious.txt", "mine\n");
  // All names that process numbers near ours would have given.
  fs::create_directories(session_ + "/out");
  for (int pid = ::getpid(); pid < ::getpid() + 2000; ++pid) {
    fs::create_symlink(precious, session_ + "/out/.light.json." + std::to_string(pid) + ".tmp");
  }
  ASSERT_EQ(RunLightcal({"fit", session_}).exit_code, 0);
  EXPECT_EQ(ReadFile(precious), "mine\n");
  EXPECT_FALSE(fs::is_symlink(session_ + "/out/light.json"));
  EXPECT_THAT(ReadFile(session_ + "/out/light.json"), HasSubstr("lightcal.light/1"));
}

TEST_F(OutputSafety, AJournalThatIsALinkElsewhereIsNotAppendedTo) {
  const std::string precious = folder_.Write("precious.txt", "mine\n");
  fs::remove(journal_);
  fs::create_symlink(precious, journal_);
  EXPECT_NE(
      RunLightcal({"read", "-s", session_, "--light", "key", "--distance", "1.5m", "--lux", "30"})
          .exit_code,
      0);
  EXPECT_EQ(ReadFile(precious), "mine\n");
}

}  // namespace
}  // namespace lightcal::test
