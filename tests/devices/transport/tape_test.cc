// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/tape.h"

#include <gmock/gmock.h>

#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"

namespace lightcal {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
constexpr milliseconds kWait{100};

Bytes AllBytes() {
  Bytes bytes;
  for (int value = 0; value < 256; ++value) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

Bytes Text(std::string_view text) {
  const auto bytes = AsBytes(text);
  return {bytes.begin(), bytes.end()};
}

Tape AskedOnce() {
  return {"sekonic",
          "sekonic:C-800",
          "2026-11-21T10:00:00Z",
          "made by hand",
          {{TapeDirection::kWrite, 0.0, Text("MN"), ""},
           {TapeDirection::kRead, 1.25, Text("MN@@@C-800"), ""},
           {TapeDirection::kReadFault, 201.5, {}, "timeout"}}};
}

TEST(Tape, TextAndBackKeepsEveryByteAndFault) {
  Tape tape = AskedOnce();
  tape.lines.push_back({TapeDirection::kRead, 300.0, AllBytes(), ""});
  tape.lines.push_back({TapeDirection::kWrite, 301.0, {}, ""});
  tape.lines.push_back({TapeDirection::kWriteFault, 302.0, {}, "unplugged"});
  const auto back = TapeFromText(TapeToText(tape), "tape");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->driver, tape.driver);
  EXPECT_EQ(back->device, tape.device);
  EXPECT_EQ(back->recorded, tape.recorded);
  EXPECT_EQ(back->note, tape.note);
  ASSERT_EQ(back->lines.size(), tape.lines.size());
  for (std::size_t i = 0; i < tape.lines.size(); ++i) {
    EXPECT_EQ(back->lines[i].direction, tape.lines[i].direction) << i;
    EXPECT_EQ(back->lines[i].elapsed_ms, tape.lines[i].elapsed_ms) << i;
    EXPECT_EQ(back->lines[i].bytes, tape.lines[i].bytes) << i;
    EXPECT_EQ(back->lines[i].code, tape.lines[i].code) << i;
  }
}

TEST(Tape, IsTextAPersonCanRead) {
  EXPECT_EQ(TapeToText(AskedOnce()),
            "lightcal-tape 1\n"
            "driver sekonic\n"
            "device sekonic:C-800\n"
            "recorded 2026-11-21T10:00:00Z\n"
            "note made by hand\n"
            "> 0 MN\n"
            "< 1.25 MN@@@C-800\n"
            "!< 201.5 timeout\n");
  EXPECT_EQ(EscapedBytes(Text("\x06\x30 \\")), "\\x060\\x20\\x5c");
}

TEST(Tape, ABadLineIsRefusedByItsNumber) {
  const std::string head = "lightcal-tape 1\ndriver sekonic\n";
  for (const char* line : {"> x MN", "> -1 MN", "> 0 a\\x0", "> 0 a\\x0g", "> 0 a\\y00", "> 0 a b",
                           "!< 3", "nonsense", "> 0 caf\xc3\xa9", "> 0 \\x-1", "> 0 \\x 1"}) {
    const auto tape = TapeFromText(head + line + "\n", "my.tape");
    ASSERT_FALSE(tape) << line;
    EXPECT_EQ(tape.error().code, "bad_tape");
    EXPECT_EQ(tape.error().kind, ErrorKind::kRefused);
    EXPECT_EQ(tape.error().subject, "my.tape:3") << line;
  }
}

TEST(Tape, AnEmptyOrForeignFileIsRefused) {
  EXPECT_EQ(TapeFromText("", "t").error().code, "bad_tape");
  EXPECT_EQ(TapeFromText("#!/bin/sh\n", "t").error().subject, "t:1");
  EXPECT_EQ(TapeFromText("lightcal-tape 1\ndriver sekonic\n", "t").error().code, "bad_tape");
  EXPECT_EQ(TapeFromText("lightcal-tape 1\n> 0 MN\n", "t").error().code, "bad_tape");
}

TEST(Replay, AnswersWhatWasAnsweredWithoutWaiting) {
  ReplayTransport line(AskedOnce());
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(line.Write(Text("MN"), kWait));
  EXPECT_EQ(*line.Read(64, kWait), Text("MN@@@C-800"));
  EXPECT_EQ(line.Unconsumed(), 1U);
  EXPECT_EQ(line.Read(64, kWait).error().code, fault::kTimeout);
  EXPECT_EQ(line.Unconsumed(), 0U);
  EXPECT_LT(std::chrono::steady_clock::now() - start, kWait);  // the tape's own took 201 ms
}

TEST(Replay, AWrongWriteShowsWhatWasExpectedAndWhatCame) {
  ReplayTransport line(AskedOnce());
  const auto done = line.Write(Text("ST"), kWait);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, fault::kTapeMismatch);
  EXPECT_THAT(done.error().message, HasSubstr("exchange 1: expected write MN, got write ST"));
  EXPECT_TRUE(line.Write(Text("MN"), kWait)) << "a wrong write plays nothing";
}

TEST(Replay, OutOfTurnIsAMismatchToo) {
  ReplayTransport line(AskedOnce());
  EXPECT_EQ(line.Read(64, kWait).error().code, fault::kTapeMismatch);
  ASSERT_TRUE(line.Write(Text("MN"), kWait));
  EXPECT_EQ(line.Write(Text("MN"), kWait).error().code, fault::kTapeMismatch);
  EXPECT_EQ(line.Read(3, kWait).error().code, fault::kIo);
}

TEST(Replay, MoreThanWasRecordedIsTheEndOfTheTape) {
  Tape tape = AskedOnce();
  tape.lines.resize(1);
  ReplayTransport line(tape);
  ASSERT_TRUE(line.Write(Text("MN"), kWait));
  EXPECT_EQ(line.Read(64, kWait).error().code, fault::kTapeEnded);
  EXPECT_EQ(line.Write(Text("MN"), kWait).error().code, fault::kTapeEnded);
}

TEST(Replay, AFailedWriteFailsAgain) {
  Tape tape = AskedOnce();
  tape.lines.resize(1);
  tape.lines.push_back({TapeDirection::kWriteFault, 5.0, {}, "unplugged"});
  ReplayTransport line(tape);
  EXPECT_EQ(line.Write(Text("MN"), kWait).error().code, fault::kUnplugged);
  EXPECT_EQ(line.Unconsumed(), 0U);
}

TEST(Recording, WritesDownExactlyWhatPassed) {
  ReplayTransport inner(AskedOnce());
  Tape tape;
  tape.driver = "sekonic";
  RecordingTransport line(inner, tape);
  EXPECT_TRUE(line.Write(Text("MN"), kWait));
  EXPECT_EQ(*line.Read(64, kWait), Text("MN@@@C-800"));
  EXPECT_FALSE(line.Read(64, kWait));
  ASSERT_EQ(tape.lines.size(), 3U);
  EXPECT_EQ(tape.lines[0].bytes, Text("MN"));
  EXPECT_EQ(tape.lines[1].bytes, Text("MN@@@C-800"));
  EXPECT_EQ(tape.lines[2].direction, TapeDirection::kReadFault);
  EXPECT_EQ(tape.lines[2].code, "timeout");
  EXPECT_LE(tape.lines[0].elapsed_ms, tape.lines[2].elapsed_ms);
}

}  // namespace
}  // namespace lightcal
