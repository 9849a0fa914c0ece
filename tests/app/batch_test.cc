// SPDX-License-Identifier: Apache-2.0
// lightcal run on many sessions, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

// The lamp of a published data sheet, its lux a little different in every copy.
std::string SessionText(int copy) {
  const double gain = 1.0 + 0.003 * copy;
  const auto reading = [&](double distance_m, double lux) {
    return "[[reading]]\nlight = \"key\"\nmeter = \"data_sheet\"\ndistance_m = " +
           std::to_string(distance_m) + "\nilluminance_lx = " + std::to_string(gain * lux) +
           "\ncct_K = 2700\n";
  };
  return "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n" + reading(1.0, 4930.0) +
         reading(3.0, 577.0) + reading(5.0, 223.0);
}

std::string NameOf(int copy) { return "lamp_" + std::to_string(1000 + copy); }

// Every file below the folder with its bytes.
std::map<std::string, std::string> Contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).string()] = ReadFile(entry.path().string());
  }
  return files;
}

// Which file it is and when it was written: any new writing changes it.
using Writing = std::tuple<ino_t, time_t, long>;
Writing WritingOf(const fs::path& path) {
  struct stat status{};
  EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
  return {status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::vector<fs::path> Stamps(const fs::path& out) {
  std::vector<fs::path> stamps;
  if (!fs::exists(out)) return stamps;
  for (const auto& entry : fs::directory_iterator(out)) {
    if (fs::exists(entry.path() / "run.json")) stamps.push_back(entry.path() / "run.json");
  }
  return stamps;
}

pid_t StartLightcal(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), LIGHTCAL_BINARY);
  const pid_t process = ::fork();
  if (process != 0) return process;
  std::vector<char*> argv;
  for (std::string& word : arguments) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::freopen("/dev/null", "w", stdout);
  ::freopen("/dev/null", "w", stderr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

TEST(RunBatch, KilledAndResumedItGivesWhatAnUninterruptedRunGivesAndDoesNothingTwice) {
  constexpr int kSessions = 100;
  constexpr std::size_t kKillAfter = 40;
  const TempDir folder;
  for (int i = 0; i < kSessions; ++i) {
    folder.Write("lamps/" + NameOf(i) + "/session.toml", SessionText(i));
  }
  const std::string lamps = folder.path() + "/lamps";
  const std::string whole = folder.path() + "/whole";
  const std::string resumed = folder.path() + "/resumed";
  const auto arguments = [&](const std::string& out) {
    return std::vector<std::string>{lamps, "-o",   out,         "--jobs",
                                    "2",   "--to", "gltf,json", "--resume"};
  };
  const json first = LightcalJson("run", arguments(whole));
  EXPECT_EQ(first["counts"]["done"], kSessions);

  std::vector<std::string> line = arguments(resumed);
  line.insert(line.begin(), "run");
  const pid_t process = StartLightcal(line);
  while (Stamps(resumed).size() < kKillAfter) {
    ASSERT_EQ(::waitpid(process, nullptr, WNOHANG), 0) << "ended before it could be killed";
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // its children die with it
  std::map<fs::path, Writing> finished;
  for (const fs::path& stamp : Stamps(resumed)) finished[stamp] = WritingOf(stamp);
  ASSERT_LT(finished.size(), kSessions);

  const json second = LightcalJson("run", arguments(resumed));
  EXPECT_EQ(second["counts"]["up_to_date"], finished.size());
  EXPECT_EQ(second["counts"]["done"], kSessions - finished.size());
  for (const auto& [stamp, writing] : finished) EXPECT_EQ(WritingOf(stamp), writing) << stamp;
  const auto expected = Contents(whole);
  const auto got = Contents(resumed);
  ASSERT_EQ(got.size(), expected.size());
  for (const auto& [name, bytes] : expected) EXPECT_EQ(got.at(name), bytes) << name;
  for (std::size_t i = 0; i < kSessions; ++i) {
    EXPECT_EQ(second["sessions"][i]["lights"], first["sessions"][i]["lights"]);
  }

  const json third = LightcalJson("run", arguments(resumed));
  EXPECT_EQ(third["counts"]["up_to_date"], kSessions);
}

TEST(RunBatch, CtrlCLetsTheRunningSessionsEndAndSaysWhatIsMissing) {
  constexpr int kSessions = 40;
  const TempDir folder;
  for (int i = 0; i < kSessions; ++i) {
    folder.Write("lamps/" + NameOf(i) + "/session.toml", SessionText(i));
  }
  const std::string out = folder.path() + "/out";
  const std::string summary = folder.path() + "/summary.json";
  const pid_t process = StartLightcal({"run", folder.path() + "/lamps", "-o", out, "--jobs", "2",
                                       "--to", "gltf", "--summary", summary});
  while (Stamps(out).size() < 5) {
    ASSERT_EQ(::waitpid(process, nullptr, WNOHANG), 0) << "ended before it could be interrupted";
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::kill(process, SIGINT);
  int status = 0;
  ::waitpid(process, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const json document = json::parse(ReadFile(summary));
  const std::size_t done = document["counts"]["done"];
  EXPECT_EQ(done, Stamps(out).size());
  EXPECT_EQ(document["counts"]["not_run"], kSessions - done);
  for (const auto& [name, bytes] : Contents(out)) {
    EXPECT_EQ(name.find(".tmp"), std::string::npos) << name;
  }
}

// Two lamps that work in a folder, with what a test puts beside them.
class Batch : public ::testing::Test {
 protected:
  Batch() {
    folder.Write("lamps/a/session.toml", SessionText(0));
    folder.Write("lamps/b/session.toml", SessionText(1));
  }
  json Run(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {lamps, "--to", "gltf"});
    return LightcalJson("run", more);
  }

  TempDir folder;
  std::string lamps = folder.path() + "/lamps";
};

TEST_F(Batch, EachOutputIsThatOfASingleRun) {
  Run();
  ASSERT_EQ(
      RunLightcal({"run", lamps + "/a", "--to", "gltf", "-o", folder.path() + "/alone"}).exit_code,
      0);
  auto in_batch = Contents(lamps + "/a/out");
  EXPECT_EQ(in_batch.erase("run.json"), 1U);
  EXPECT_EQ(in_batch, Contents(folder.path() + "/alone"));
}

TEST_F(Batch, WhateverDecidesTheOutputsIsRunAgain) {
  const auto up_to_date = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = more;
    arguments.emplace_back("--resume");
    return int(Run(arguments)["counts"]["up_to_date"]);
  };
  EXPECT_EQ(up_to_date(), 0);
  EXPECT_EQ(up_to_date(), 2);
  EXPECT_EQ(up_to_date({"--tol", "2%"}), 0) << "another setting";
  EXPECT_EQ(up_to_date(), 0);
  ASSERT_EQ(RunLightcal(
                {"read", "-s", lamps + "/a", "--light", "key", "--distance", "2m", "--lux", "1290"})
                .exit_code,
            0);
  EXPECT_EQ(up_to_date(), 1) << "a new reading, in a journal that was not there before";
  folder.Write("lamps/b/session.toml", SessionText(7));
  EXPECT_EQ(up_to_date(), 1) << "a changed session";
  fs::remove(lamps + "/b/out/light.json");
  EXPECT_EQ(up_to_date(), 1) << "a lost output";
  const std::string page = ReadFile(lamps + "/b/out/report.html");
  folder.Write("lamps/b/out/report.html", page + "<!-- edited by hand -->");
  EXPECT_EQ(up_to_date(), 1) << "a changed output";
  folder.Write("lamps/b/out/report.html", "notes about lightcal, none of its own");
  EXPECT_EQ(RunLightcal({"run", lamps + "/b", "--resume", "--to", "gltf"}).exit_code, 1)
      << "a person's file in its place";
  EXPECT_EQ(ReadFile(lamps + "/b/out/report.html"), "notes about lightcal, none of its own");
  folder.Write("lamps/b/out/report.html", page);
  EXPECT_GE(up_to_date(), 1);
  EXPECT_EQ(up_to_date(), 2);
}

TEST_F(Batch, OneThatIsRefusedDoesNotStopTheOthers) {
  folder.Write("lamps/c/session.toml", SessionText(0) + "nonsense = 1\n");
  const std::string summary = folder.path() + "/summary.json";
  const CliResult result =
      RunLightcal({"run", lamps, "--to", "gltf", "--json", "--summary", summary});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(document["counts"]["done"], 2);
  EXPECT_EQ(document["counts"]["refused"], 1);
  EXPECT_EQ(document["error"]["code"], "sessions_refused");
  EXPECT_EQ(document["sessions"][2]["error"]["code"], "unknown_key");
  EXPECT_EQ(document["sessions"][0]["lights"][0]["name"], "key");
  const json written = json::parse(ReadFile(summary));
  EXPECT_EQ(written["sessions"], document["sessions"]);
  EXPECT_FALSE(fs::exists(lamps + "/c/out"));
}

TEST_F(Batch, WarningsAreCountedBySessionAndSaidInFullWhenAskedFor) {
  // A journal whose last line is torn.
  folder.Write("lamps/b/readings.jsonl", "{\"light\": \"key\", ");
  const CliResult brief = RunLightcal({"run", lamps, "--to", "gltf", "--json"});
  const CliResult full = RunLightcal({"run", lamps, "--to", "gltf", "--json", "--verbose"});
  const CliResult alone = RunLightcal({"run", lamps + "/b", "--to", "gltf", "--jobs", "1"});
  ASSERT_EQ(brief.exit_code, 0) << brief.err;
  EXPECT_EQ(brief.out, full.out);
  const json warnings = json::parse(brief.out)["warnings"];
  const auto of_b = static_cast<std::size_t>(std::ranges::count_if(warnings, [&](const json& w) {
    return std::string(w["subject"]).starts_with(lamps + "/b");
  }));
  const std::string code = warnings.back()["code"], message = warnings.back()["message"];
  EXPECT_THAT(brief.err, HasSubstr(lamps + "/b: " + std::to_string(of_b) + " warning"));
  EXPECT_THAT(brief.err, HasSubstr(code));
  EXPECT_THAT(brief.err, Not(HasSubstr(message)));
  EXPECT_THAT(brief.err, HasSubstr("--verbose"));
  EXPECT_THAT(full.err, HasSubstr(message));
  EXPECT_THAT(alone.err, HasSubstr(message));
}

TEST_F(Batch, OneThatFailsWeighsMoreThanOneRefused) {
  folder.Write("lamps/a/out/report.html", "my holiday pictures");
  folder.Write("lamps/c/session.toml", "lightcal = 1\n");
  const CliResult result = RunLightcal({"run", lamps, "--to", "gltf"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("failed"));
  EXPECT_THAT(result.out, HasSubstr("refused"));
  EXPECT_THAT(result.err, HasSubstr("3 sessions: 1 done, 1 refused, 1 failed"));
  EXPECT_EQ(ReadFile(lamps + "/a/out/report.html"), "my holiday pictures");
}

TEST_F(Batch, AWrongLineIsSaidOnceAndNothingIsWritten) {
  const CliResult result = RunLightcal({"run", lamps, "--to", "gltv", "--json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, HasSubstr("gltf"));
  EXPECT_FALSE(fs::exists(lamps + "/a/out"));
  EXPECT_EQ(RunLightcal({"run", lamps, "--jobs", "0"}).exit_code, 2);
  EXPECT_EQ(
      RunLightcal({"run", lamps, "--to", "gltf", "-o", folder.path() + "/o", "--resume"}).exit_code,
      0);
  EXPECT_TRUE(fs::exists(folder.path() + "/o/b/light.json"));
}

TEST_F(Batch, SessionsThatWouldWriteToOnePlaceAreRefused) {
  folder.Write("x.toml", SessionText(0));
  folder.Write("y.toml", SessionText(1));
  const CliResult result =
      RunLightcal({"run", folder.path() + "/x.toml", folder.path() + "/y.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("x.toml"));
  EXPECT_EQ(RunLightcal({"run", folder.path() + "/x.toml", folder.path() + "/y.toml", "-o",
                         folder.path() + "/xy", "--to", "gltf"})
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(folder.path() + "/xy/x/x.gltf"));
}

TEST_F(Batch, OneSessionOfAJobArrayIsLeftAloneTheSecondTime) {
  const std::vector<std::string> line = {"run", lamps + "/a", "--to", "gltf", "--resume"};
  ASSERT_EQ(RunLightcal(line).exit_code, 0);
  const Writing writing = WritingOf(lamps + "/a/out/light.json");
  const CliResult again = RunLightcal(line);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr("up to date"));
  EXPECT_EQ(WritingOf(lamps + "/a/out/light.json"), writing);
}

// Permissions do not bind root, who runs the binary as nobody.
class BatchOfNobody : public Batch {
 protected:
  BatchOfNobody() {
    fs::permissions(folder.path(), fs::perms(0755));
    fs::create_directory(out);
    fs::permissions(out, fs::perms(0777));
  }
  ~BatchOfNobody() override {
    for (const std::string& one : locked) fs::permissions(one, fs::perms(0755));
  }
  void Lock(const std::string& one) {
    fs::permissions(one, fs::perms::none);
    locked.push_back(one);
  }
  CliResult Ask(std::vector<std::string> words) const {
    words.emplace_back("--json");
    std::vector<std::string> as_nobody = {"setpriv", "--reuid=65534", "--clear-groups"};
    return RunLightcal(words, "", {}, ::geteuid() == 0 ? as_nobody : std::vector<std::string>());
  }

  std::string out = folder.path() + "/out";
  std::vector<std::string> locked;
};

TEST_F(BatchOfNobody, AFolderThatMayNotBeEnteredIsASessionThatFails) {
  Lock(lamps + "/b");
  const CliResult result = Ask({"run", lamps, "-o", out, "--to", "gltf"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(document["counts"]["done"], 1);
  EXPECT_EQ(document["sessions"][1]["status"], "failed");
  EXPECT_EQ(document["sessions"][1]["error"]["code"], "no_permission");
  const CliResult alone = Ask({"run", lamps + "/b", "-o", out, "--to", "gltf"});
  EXPECT_EQ(json::parse(alone.out)["error"]["code"], "no_permission");
  const CliResult validated = Ask({"validate", lamps});
  EXPECT_EQ(validated.exit_code, 1);
  EXPECT_EQ(json::parse(validated.out)["files"].size(), 2U);
}

TEST_F(BatchOfNobody, AnOutputFolderThatMayNotBeEnteredFails) {
  const std::vector<std::string> words = {"run", lamps, "-o", out, "--to", "gltf", "--resume"};
  ASSERT_EQ(Ask(words).exit_code, 0);
  Lock(out + "/a");
  const CliResult result = Ask(words);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const json a = json::parse(result.out)["sessions"][0];
  EXPECT_EQ(a["error"]["code"], "unwritable");
  EXPECT_THAT(std::string(a["error"]["message"]), HasSubstr("Permission denied"));
}

TEST_F(Batch, WildcardsAreExpandedAndEachSessionRunOnce) {
  const CliResult result = RunLightcal(
      {"run", lamps + "/*", lamps + "/a", lamps + "/b/session.toml", "--to", "gltf", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["sessions"].size(), 2U);
  EXPECT_EQ(RunLightcal({"run", lamps + "/z*"}).exit_code, 3);
}

}  // namespace
}  // namespace lightcal::test
