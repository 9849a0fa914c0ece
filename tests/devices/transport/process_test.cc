// SPDX-License-Identifier: Apache-2.0
// Real programs: /bin/sh, as every line:!program and spotread is run.
#include "lightcal_devices/transport/process.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"
#include "run_cli.h"
#include "text_of_bytes.h"

namespace lightcal::devices {
namespace {

using test::Text;

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr milliseconds kLong{10000};
constexpr milliseconds kShort{60};

std::unique_ptr<Transport> Shell(milliseconds longest_run = milliseconds(0)) {
  return OpenProcess({.program = "/bin/sh", .environment = {}, .longest_run = longest_run});
}

Result<Bytes> Start(Transport& line, const std::string& script) {
  return line.Control("start", StartArguments({"-c", script}), 0, kLong);
}

// Everything until the program is over, and the words it is over with.
struct Outcome {
  std::string printed;
  Error end;
};
Outcome ReadAll(Transport& line, std::size_t max = 4096) {
  Outcome run;
  for (;;) {
    const auto bytes = line.Read(max, kLong);
    if (!bytes) {
      run.end = bytes.error();
      return run;
    }
    EXPECT_FALSE(bytes->empty());
    EXPECT_LE(bytes->size(), max);
    run.printed += Text(*bytes);
  }
}

int OpenDescriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<int>(std::distance(begin(all), end(all)));
}

bool IsAlive(pid_t pid) {
  const std::string stat = test::ReadFile("/proc/" + std::to_string(pid) + "/stat");
  return !stat.empty() && stat.find(") Z ") == std::string::npos;
}

// Whether the process is gone within 5 s.
bool Goes(pid_t pid) {
  for (int i = 0; i < 1000; ++i) {
    if (!IsAlive(pid)) return true;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return false;
}

TEST(Process, BothItsStreamsAreReadAndItsExitCodeIsTold) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "echo 192.5; echo careful >&2; exit 7"));
  const Outcome run = ReadAll(*line);
  EXPECT_EQ(run.printed, "192.5\ncareful\n");
  EXPECT_EQ(run.end.code, fault::kEnded);
  EXPECT_THAT(run.end.message, HasSubstr("exit code 7"));
  EXPECT_EQ(Text(*line->Control("exit_status", {}, 16, kLong)), "7");
}

TEST(Process, AReadGivesAtMostWhatWasAskedFor) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "printf 123456789"));
  EXPECT_EQ(ReadAll(*line, 2).printed, "123456789");
}

TEST(Process, MuchOutputArrivesWhole) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "i=0; while [ $i -lt 20000 ]; do echo 1234567; i=$((i+1)); done"));
  EXPECT_EQ(ReadAll(*line, 4096).printed.size(), 160000U);
}

TEST(Process, ASilentProgramIsATimeoutAndStillRuns) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "read word; echo got $word"));
  EXPECT_EQ(line->Read(64, kShort).error().code, fault::kTimeout);
  EXPECT_EQ(line->Control("exit_status", {}, 16, kShort).error().code, fault::kTimeout);
  ASSERT_TRUE(line->Write(AsBytes("q\n"), kLong));
  EXPECT_EQ(ReadAll(*line).printed, "got q\n");
}

TEST(Process, ItsInputStaysOpenUntilTheEnd) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "if read word; then echo word; else echo eof; fi"));
  EXPECT_EQ(line->Read(64, kShort).error().code, fault::kTimeout);
}

TEST(Process, WritingToAProgramThatIsOverFailsInsteadOfEndingUs) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "exit 0"));
  (void)ReadAll(*line);
  EXPECT_EQ(line->Write(AsBytes("q\n"), kLong).error().code, fault::kEnded);
}

TEST(Process, WritingToAProgramThatDoesNotReadIsATimeout) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "sleep 60"));
  const Bytes much(1 << 20);
  EXPECT_EQ(line->Write(much, kShort).error().code, fault::kTimeout);
}

TEST(Process, ArgumentsArriveAsGivenAndNulSeparatesThemToo) {
  auto line = Shell();
  ASSERT_TRUE(line->Control(
      "start", StartArguments({"-c", "printf '[%s]' \"$@\"", "sh", "a b", "", "c"}), 0, kLong));
  EXPECT_EQ(ReadAll(*line).printed, "[a b][][c]");
  using std::string_view_literals::operator""sv;
  ASSERT_TRUE(line->Control("start", AsBytes("-c\0printf '<%s>' \"$@\"\0sh\0x y"sv), 0, kLong));
  EXPECT_EQ(ReadAll(*line).printed, "<x y>");
}

TEST(Process, ItSpeaksTheCLocaleAndHasTheEnvironmentItIsGiven) {
  ::setenv("LIGHTCAL_TEST_KEPT", "kept", 1);
  auto line = OpenProcess({.program = "/bin/sh",
                           .environment = {"LIGHTCAL_TEST_WORD=two words"},
                           .longest_run = milliseconds(0)});
  ASSERT_TRUE(Start(*line, "echo $LC_ALL $LIGHTCAL_TEST_KEPT $LIGHTCAL_TEST_WORD"));
  EXPECT_EQ(ReadAll(*line).printed, "C kept two words\n");
}

TEST(Process, ASecondStartEndsTheFirst) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "echo $$; sleep 60"));
  const pid_t first = std::stoi(Text(*line->Read(64, kLong)));
  ASSERT_TRUE(Start(*line, "echo again"));
  EXPECT_FALSE(IsAlive(first));
  EXPECT_EQ(ReadAll(*line).printed, "again\n");
}

TEST(Process, TheWholeGroupGoesEvenOneThatIgnoresSigterm) {
  pid_t leader = 0;
  pid_t helper = 0;
  {
    auto line = Shell();
    ASSERT_TRUE(Start(*line, "trap '' TERM; sleep 60 & echo $$ $!; wait; sleep 60"));
    const std::string pids = Text(*line->Read(64, kLong));
    std::size_t used = 0;
    leader = std::stoi(pids, &used);
    helper = std::stoi(pids.substr(used));
  }
  EXPECT_TRUE(Goes(leader));
  EXPECT_TRUE(Goes(helper));
  EXPECT_EQ(::waitpid(leader, nullptr, WNOHANG), -1);  // no zombie is left
  EXPECT_EQ(errno, ECHILD);
}

TEST(Process, ARunBeyondItsLimitIsStoppedAndSaysSo) {
  auto line = Shell(milliseconds(80));
  ASSERT_TRUE(Start(*line, "echo $$; sleep 60"));
  const pid_t pid = std::stoi(Text(*line->Read(64, kLong)));
  const auto late = line->Read(64, kLong);
  EXPECT_EQ(late.error().code, fault::kEnded);
  EXPECT_THAT(late.error().message, HasSubstr("longer than 80 ms"));
  EXPECT_FALSE(IsAlive(pid));
  EXPECT_THAT(line->Read(64, kLong).error().message, HasSubstr("longer than 80 ms"));
}

TEST(Process, AHelperThatKeepsTheOutputOpenDoesNotHideTheEnd) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "sleep 60 & echo done; exit 3"));
  const Outcome run = ReadAll(*line);
  EXPECT_EQ(run.printed, "done\n");
  EXPECT_THAT(run.end.message, HasSubstr("exit code 3"));
}

TEST(Process, ACrashIsToldByItsSignal) {
  auto line = Shell();
  ASSERT_TRUE(Start(*line, "kill -SEGV $$"));
  EXPECT_EQ(ReadAll(*line).end.code, fault::kEnded);
  EXPECT_EQ(Text(*line->Control("exit_status", {}, 16, kLong)), "signal 11");
}

TEST(Process, AProgramThatIsNotThereOrMayNotRunIsTyped) {
  const test::TempDir folder;
  const std::string plain = folder.Write("plain", "192\n");
  auto line = OpenProcess(
      {.program = "no-such-program-at-all", .environment = {}, .longest_run = milliseconds(0)});
  EXPECT_EQ(line->Control("start", {}, 0, kLong).error().code, fault::kNoDevice);
  ASSERT_TRUE(line->Control("program", AsBytes(plain), 0, kLong));
  EXPECT_EQ(line->Control("start", {}, 0, kLong).error().code, fault::kNoPermission);
  EXPECT_EQ(line->Read(8, kShort).error().code, fault::kEnded);
  EXPECT_EQ(line->Write(AsBytes("x"), kShort).error().code, fault::kEnded);
  EXPECT_EQ(line->Control("sing", {}, 8, kShort).error().code, fault::kIo);
}

TEST(Process, LeavesNoDescriptorBehindAndGivesNoneAway) {
  const auto descriptors_of_a_program = [] {
    auto line = Shell();
    EXPECT_TRUE(Start(*line, "ls /proc/self/fd | wc -l"));
    return ReadAll(*line).printed;
  };
  const std::string alone = descriptors_of_a_program();
  const int before = OpenDescriptors();
  {
    auto other = Shell();
    auto third = Shell();
    ASSERT_TRUE(Start(*other, "sleep 60"));
    ASSERT_TRUE(Start(*third, "sleep 60"));
    EXPECT_EQ(OpenDescriptors(), before + 4);
    EXPECT_EQ(descriptors_of_a_program(), alone);
  }
  EXPECT_EQ(OpenDescriptors(), before);
}

TEST(Process, ProgramsAreFoundOnPath) {
  EXPECT_THAT(ProgramOnPath("sh").value_or(""), testing::EndsWith("/sh"));
  EXPECT_EQ(ProgramOnPath("/bin/sh"), "/bin/sh");
  EXPECT_EQ(ProgramOnPath("no-such-program-at-all"), std::nullopt);
  EXPECT_EQ(ProgramOnPath(""), std::nullopt);
}

TEST(Process, AStartAndItsEndAreOnTheTape) {
  auto line = Shell();
  Tape tape;
  tape.driver = "line";
  RecordingTransport recording(*line, tape);
  ASSERT_TRUE(Start(recording, "echo 5"));
  (void)ReadAll(recording);
  ReplayTransport replay(tape);
  ASSERT_TRUE(Start(replay, "echo 5"));
  const Outcome again = ReadAll(replay);
  EXPECT_EQ(again.printed, "5\n");
  EXPECT_EQ(again.end.code, fault::kEnded);
}

}  // namespace
}  // namespace lightcal::devices
