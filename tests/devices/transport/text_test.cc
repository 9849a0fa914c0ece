// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/text.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "pseudo_terminal.h"
#include "run_cli.h"

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;
using test::PseudoTerminal;
using test::TempDir;
using testing::HasSubstr;

constexpr milliseconds kLineWait{2000};

std::string Line(Transport& source, milliseconds wait = kLineWait) {
  const auto line = source.Read(256, wait);
  if (!line) return "(" + line.error().code + ")";
  std::string text;
  for (const std::byte byte : *line) text.push_back(static_cast<char>(byte));
  return text;
}

struct Fifo {
  TempDir dir;
  std::string path = dir.path() + "/lux";
  Fifo() { ::mkfifo(path.c_str(), 0600); }
  void Write(const std::string& text) const {
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    EXPECT_EQ(::write(file, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(file);
  }
};

TEST(TextSource, AFifoGivesItsLinesInTurnAndOutlivesItsWriters) {
  const Fifo fifo;
  const auto source = OpenTextSource(fifo.path);
  ASSERT_TRUE(source) << source.error().message;
  fifo.Write("192\r\n193,5600\n\n");
  EXPECT_EQ(Line(**source), "192");
  EXPECT_EQ(Line(**source), "193,5600");
  EXPECT_EQ(Line(**source, milliseconds(20)), "(timeout)");
  fifo.Write("19");
  fifo.Write("4\n");
  EXPECT_EQ(Line(**source), "194");
}

TEST(TextSource, OfOldLinesInAFifoTheLastIsKept) {
  const Fifo fifo;
  const auto source = OpenTextSource(fifo.path);
  fifo.Write("1\n");
  EXPECT_EQ(Line(**source), "1");
  fifo.Write("2\n3\n4\n5");
  std::this_thread::sleep_for(kStaleAfter + milliseconds(100));
  fifo.Write("5\n");
  EXPECT_EQ(Line(**source), "55");
}

TEST(TextSource, APortThatIsInTheMiddleOfALineIsReadFromTheNext) {
  const PseudoTerminal terminal;
  const auto source = OpenTextSource(terminal.path());
  ASSERT_TRUE(source) << source.error().message;
  terminal.Send("2.5\n193.5\n");  // the end of 192.5
  EXPECT_EQ(Line(**source), "193.5");
}

TEST(TextSource, APortThatWasSilentIsReadFromItsFirstLine) {
  const PseudoTerminal terminal;
  const auto source = OpenTextSource(terminal.path());
  std::thread instrument([&] {
    std::this_thread::sleep_for(kJoinSilence * 4);
    terminal.Send("192\r\n");
  });
  EXPECT_EQ(Line(**source), "192");
  instrument.join();
}

TEST(TextSource, OldLinesOfAPortAreOldLight) {
  const PseudoTerminal terminal;
  const auto source = OpenTextSource(terminal.path());
  terminal.Send("x\n1\n");
  EXPECT_EQ(Line(**source), "1");
  terminal.Send("2\n3\n4");
  std::this_thread::sleep_for(kStaleAfter + milliseconds(100));
  std::thread instrument([&] {
    std::this_thread::sleep_for(milliseconds(100));
    terminal.Send("0\n");
  });
  EXPECT_EQ(Line(**source), "40");
  instrument.join();
}

TEST(TextSource, OfWhatCameInAPauseTheLastLineIsReadFirst) {
  const Fifo fifo;
  const auto lines = OpenTextSource(fifo.path);
  const auto program = OpenTextSource("!echo 1; sleep 0.05; echo 2");
  PseudoTerminal terminal;
  const auto port = OpenTextSource(terminal.path());
  fifo.Write("1\n");
  EXPECT_EQ(Line(**lines), "1");
  fifo.Write("2\n3\n4\n5");
  (*lines)->Paused();
  EXPECT_EQ(Line(**lines), "4");
  fifo.Write("\n6\n");
  EXPECT_EQ(Line(**lines), "5") << "no pause, nothing old";
  (*lines)->Paused();
  EXPECT_EQ(Line(**lines), "6") << "one line is the newest";
  EXPECT_EQ(Line(**port, milliseconds(10)), "(timeout)");
  terminal.Send("1\n2\n3\n");
  (*port)->Paused();
  EXPECT_EQ(Line(**port), "3");
  EXPECT_EQ(Line(**program), "1");
  (*program)->Paused();
  EXPECT_EQ(Line(**program), "2") << "what a slow program prints once";
}

TEST(TextSource, AnUnpluggedPortIsSaid) {
  PseudoTerminal terminal;
  const auto source = OpenTextSource(terminal.path());
  terminal.Unplug();
  EXPECT_EQ(Line(**source), "(unplugged)");
}

TEST(TextSource, AProgramThatPrintsOneNumberIsRunForEachReading) {
  const TempDir dir;
  const std::string count = dir.path() + "/count";
  const auto source = OpenTextSource("!echo x >> " + count + "; wc -l < " + count);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(Line(**source), "1");
  EXPECT_EQ(Line(**source), "(ended)");
  EXPECT_EQ(Line(**source), "2");
}

TEST(TextSource, AProgramThatGoesOnIsReadOn) {
  const auto source = OpenTextSource("!printf '1\\n2\\n'; sleep 60");
  EXPECT_EQ(Line(**source), "1");
  EXPECT_EQ(Line(**source), "2");
  EXPECT_EQ(Line(**source, milliseconds(50)), "(timeout)");
}

TEST(TextSource, WhatIsNoSourceIsSaid) {
  const TempDir dir;
  EXPECT_EQ(OpenTextSource(dir.path() + "/none").error().code, fault::kNoDevice);
  const auto file = OpenTextSource(dir.Write("log.txt", "192\n"));
  EXPECT_EQ(file.error().code, fault::kIo);
  EXPECT_THAT(file.error().message, HasSubstr("lightcal import"));
  EXPECT_EQ(OpenTextSource("/dev/null").error().code, fault::kIo);
}

TEST(TextSource, ALineWithoutEndIsCutAtTheBound) {
  const Fifo fifo;
  const auto source = OpenTextSource(fifo.path);
  fifo.Write(std::string(1000, '1') + "\n7\n");
  EXPECT_EQ(Line(**source).size(), 256U);
}

}  // namespace
}  // namespace lightcal::devices
