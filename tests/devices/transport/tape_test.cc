// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"
#include "lightcal_devices/transport/tape_codec.h"

namespace lightcal::devices {
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
          "",
          "made by hand",
          {{TapeOperation::kWrite, 0.0, "", Text("MN"), {}, ""},
           {TapeOperation::kRead, 1.25, "", {}, Text("MN@@@C-800"), ""},
           {TapeOperation::kRead, 201.5, "", {}, {}, "timeout"}}};
}

TEST(Tape, TextAndBackKeepsEveryByteAndFault) {
  Tape tape = AskedOnce();
  tape.exchanges.push_back({TapeOperation::kRead, 300.0, "", {}, AllBytes(), ""});
  tape.exchanges.push_back({TapeOperation::kWrite, 301.0, "", {}, {}, ""});
  tape.exchanges.push_back({TapeOperation::kWrite, 302.0, "", Text("x"), {}, "unplugged"});
  tape.exchanges.push_back(
      {TapeOperation::kControl, 303.0, "get_feature", AllBytes(), Text("\r\n"), ""});
  const auto back = TapeFromText(TapeToText(tape), "tape");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->driver, tape.driver);
  EXPECT_EQ(back->device, tape.device);
  EXPECT_EQ(back->recorded, tape.recorded);
  EXPECT_EQ(back->note, tape.note);
  ASSERT_EQ(back->exchanges.size(), tape.exchanges.size());
  for (std::size_t i = 0; i < tape.exchanges.size(); ++i) {
    const TapeExchange& got = back->exchanges[i];
    const TapeExchange& expected = tape.exchanges[i];
    EXPECT_EQ(got.operation, expected.operation) << i;
    EXPECT_EQ(got.elapsed_ms, expected.elapsed_ms) << i;
    EXPECT_EQ(got.verb, expected.verb) << i;
    EXPECT_EQ(got.sent, expected.sent) << i;
    EXPECT_EQ(got.received, expected.received) << i;
    EXPECT_EQ(got.fault, expected.fault) << i;
  }
}

TEST(Tape, IsTextAPersonCanRead) {
  Tape tape = AskedOnce();
  tape.exchanges.push_back(
      {TapeOperation::kControl, 300.0, "get_feature", Text("\x05"), {std::byte{0xff}}, ""});
  EXPECT_EQ(TapeToText(tape), R"({"schema":"lightcal.tape/1","driver":"sekonic",)"
                              R"("device":"sekonic:C-800","recorded":"2026-11-21T10:00:00Z",)"
                              R"("note":"made by hand"})"
                              "\n"
                              R"({"t_ms":0.0,"op":"write","sent":"MN"})"
                              "\n"
                              R"({"t_ms":1.25,"op":"read","got":"MN@@@C-800"})"
                              "\n"
                              R"({"t_ms":201.5,"op":"read","fault":"timeout"})"
                              "\n"
                              R"({"t_ms":300.0,"op":"control","verb":"get_feature",)"
                              R"("sent":"\u0005","got_hex":"ff"})"
                              "\n");
  EXPECT_EQ(EscapedBytes(Text("\x06\x30 \\")), "\\x060\\x20\\x5c");
}

TEST(Tape, ABadLineIsRefusedByItsNumber) {
  const std::string head = "{\"schema\":\"lightcal.tape/1\",\"driver\":\"sekonic\"}\n";
  for (const char* line :
       {R"({"op":"write"})", R"({"t_ms":-1,"op":"write"})", R"({"t_ms":"1","op":"write"})",
        R"({"t_ms":0,"op":"sing"})", R"({"t_ms":0,"op":"read","got_hex":"0"})",
        R"({"t_ms":0,"op":"read","got_hex":"0g"})", R"({"t_ms":0,"op":"read","got":"caf\u00e9"})",
        R"({"t_ms":0,"op":"read","sent":"a"})", R"({"t_ms":0,"op":"write","got":"a"})",
        R"({"t_ms":0,"op":"read","got":"a","fault":"timeout"})", R"({"t_ms":0,"op":"control"})",
        R"({"t_ms":0,"op":"read","verb":"x"})", R"({"t_ms":0,"op":"read","gott":"a"})",
        R"({"t_ms":0,"op":"read","got":7})", R"(["t_ms"])", "nonsense"}) {
    const auto tape = TapeFromText(head + line + "\n", "my.tape");
    ASSERT_FALSE(tape) << line;
    EXPECT_EQ(tape.error().code, "bad_tape");
    EXPECT_EQ(tape.error().kind, ErrorKind::kRefused);
    EXPECT_EQ(tape.error().subject, "my.tape:2") << line;
  }
}

TEST(Tape, AMessageStaysShortWhateverTheLineHolds) {
  const std::string line = "{\"t_ms\":0,\"" + std::string(5000, 'k') + "\":1}\n";
  const auto tape = TapeFromText("{\"schema\":\"lightcal.tape/1\",\"driver\":\"a\"}\n" + line, "t");
  EXPECT_LT(tape.error().message.size(), 200U);
}

TEST(Tape, AnEmptyOrForeignFileIsRefused) {
  EXPECT_EQ(TapeFromText("", "t").error().code, "bad_tape");
  for (const char* foreign : {"#!/bin/sh\n", "{}\n", "{\"schema\":\"lightcal.tape/1\"}\n",
                              "{\"schema\":\"lightcal.tape/2\",\"driver\":\"a\"}\n"}) {
    EXPECT_EQ(TapeFromText(foreign, "t").error().subject, "t:1") << foreign;
  }
  EXPECT_EQ(
      TapeFromText("{\"schema\":\"lightcal.tape/1\",\"driver\":\"a\"}\n", "t").error().subject,
      "t");
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
  tape.exchanges.resize(1);
  ReplayTransport line(tape);
  ASSERT_TRUE(line.Write(Text("MN"), kWait));
  EXPECT_EQ(line.Read(64, kWait).error().code, fault::kTapeEnded);
  EXPECT_EQ(line.Write(Text("MN"), kWait).error().code, fault::kTapeEnded);
}

TEST(Replay, AFailedWriteFailsAgain) {
  Tape tape = AskedOnce();
  tape.exchanges.resize(1);
  tape.exchanges.front().fault = "unplugged";
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
  ASSERT_EQ(tape.exchanges.size(), 3U);
  EXPECT_EQ(tape.exchanges[0].sent, Text("MN"));
  EXPECT_EQ(tape.exchanges[1].received, Text("MN@@@C-800"));
  EXPECT_EQ(tape.exchanges[2].operation, TapeOperation::kRead);
  EXPECT_EQ(tape.exchanges[2].fault, "timeout");
  EXPECT_LE(tape.exchanges[0].elapsed_ms, tape.exchanges[2].elapsed_ms);
}

TEST(TapeText, TheDriversOptionsAreKept) {
  Tape tape = AskedOnce();
  tape.settings = "sensor=bh1750\naddress=0x5c";
  const auto read_back = TapeFromText(TapeToText(tape), "tape");
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(read_back->settings, tape.settings);
  EXPECT_EQ(read_back->note, tape.note);
}

TEST(Control, IsRecordedAndPlayedByItsVerbAndBytes) {
  Tape tape{"hid", "", "", "", "", {}};
  tape.exchanges.push_back(
      {TapeOperation::kControl, 0.0, "get_feature", Text("5"), Text("on"), ""});
  ReplayTransport inner(tape);
  Tape again;
  RecordingTransport line(inner, again);
  EXPECT_EQ(line.Control("set_feature", Text("5"), 64, kWait).error().code, fault::kTapeMismatch);
  EXPECT_EQ(*line.Control("get_feature", Text("5"), 64, kWait), Text("on"));
  ASSERT_EQ(again.exchanges.size(), 2U);
  EXPECT_EQ(again.exchanges[1].verb, "get_feature");
  EXPECT_EQ(again.exchanges[1].received, Text("on"));
}

}  // namespace
}  // namespace lightcal::devices
