// SPDX-License-Identifier: Apache-2.0
// The dialogue, on a line in memory: no waiting, every fault.
#include "lightcal_devices/meters/display_meter.h"
#include "stream_meters.h"

namespace lightcal::devices::pce174 {
namespace {

using test::Hex;
using test::Spoken;
using test::StreamFake;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr test::Make kMake = MakeDisplayMeter<kProtocol>;

const std::string kRead = Hex("87 83 11");

// The reference's reply with other status bytes and digits.
std::string Reply(const std::string& raw = "0C 22", const std::string& status = "81 00") {
  return Hex("AA DD 00 26 06 11 21 12 34 56 0C 22 " + raw + " " + status + " 00 01");
}

// Answers each read command with the next reply, the last one again and again.
test::Speak Answering(std::vector<std::string> replies) {
  return [replies = std::move(replies), next = std::size_t{0}](std::string& unread) mutable {
    if (unread.find(kRead) == std::string::npos || replies.empty()) return Spoken{};
    unread.clear();
    const std::string reply = replies[next];
    if (next + 1 < replies.size()) ++next;
    return Spoken{reply, false};
  };
}

std::string CodeOf(std::vector<std::string> replies) {
  const auto reading = test::Measured(Answering(std::move(replies)), kMake);
  return reading ? "" : reading.error().code;
}

TEST(Pce174Meter, AsksOnceAndReads) {
  StreamFake line(Answering({Reply()}));
  const auto reading = test::MeasuredOn(line, kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  EXPECT_EQ(reading->reading.device, "pce174:PCE-174");
  EXPECT_THAT(reading->warnings, IsEmpty());
  EXPECT_THAT(line.writes(), ElementsAre(kRead));
}

TEST(Pce174Meter, EveryModeButTheNormalOneIsRefusedByName) {
  const std::vector<std::pair<std::string, std::string>> modes = {
      {"C1 00", "HOLD"}, {"91 00", "PMIN"}, {"99 00", "PMAX"}, {"A1 00", "MAX"},
      {"A9 00", "MIN"},  {"B1 00", "REL"},  {"81 02", "LOAD"}};
  for (const auto& [status, name] : modes) {
    const auto reading = test::Measured(Answering({Reply("0C 22", status)}), kMake);
    ASSERT_FALSE(reading) << name;
    EXPECT_EQ(reading.error().code, "hold");
    EXPECT_THAT(reading.error().message, HasSubstr("shows " + name));
  }
}

TEST(Pce174Meter, ALowBatteryWarns) {
  const auto reading = test::Measured(Answering({Reply("0C 22", "81 20")}), kMake);
  EXPECT_THAT(test::CodesOf(*reading), ElementsAre("battery_low"));
}

// 4000 counts, in decimal pairs 40 00, end every range.
TEST(Pce174Meter, BeyondTheRangeIsCensoredAtItsEnd) {
  const auto inside = test::Measured(Answering({Reply("28 00", "81 00")}), kMake);
  EXPECT_FALSE(inside->reading.over_range);
  EXPECT_EQ(inside->reading.illuminance->value(), 400.0);
  const auto beyond = test::Measured(Answering({Reply("28 01", "81 00")}), kMake);
  EXPECT_TRUE(beyond->reading.over_range);
  EXPECT_EQ(beyond->reading.illuminance->value(), 400.0);
  const auto highest = test::Measured(Answering({Reply("63 63", "80 00")}), kMake);
  EXPECT_TRUE(highest->reading.over_range);
  EXPECT_EQ(highest->reading.illuminance->value(), 400000.0);
}

TEST(Pce174Meter, LessThanNoLightIsRefused) {
  EXPECT_EQ(CodeOf({Reply("00 03", "81 10")}), "negative_reading");
}

TEST(Pce174Meter, NoiseBeforeTheReplyDoesNoHarm) {
  const auto reading = test::Measured(Answering({"\xFF\xAA" + Reply()}), kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
}

TEST(Pce174Meter, ALateReplyIsNotTakenForTheNext) {
  StreamFake line(Answering({Reply()}), Reply("00 00"));
  EXPECT_EQ(test::MeasuredOn(line, kMake)->reading.illuminance->value(), 123.4);
}

TEST(Pce174Meter, OneDamagedReplyIsAskedForOnceMore) {
  StreamFake line(Answering({Reply("7F 7F"), Reply()}));
  ASSERT_TRUE(test::MeasuredOn(line, kMake));
  EXPECT_THAT(line.writes(), ElementsAre(kRead, kRead));
  StreamFake torn(Answering({Reply().substr(0, 9), Reply()}));
  EXPECT_TRUE(test::MeasuredOn(torn, kMake));
}

TEST(Pce174Meter, TwoDamagedRepliesAreAnError) {
  StreamFake line(Answering({Reply("7F 7F")}));
  EXPECT_EQ(test::MeasuredOn(line, kMake).error().code, "bad_reply");
  EXPECT_THAT(line.writes(), ElementsAre(kRead, kRead));
  EXPECT_EQ(CodeOf({std::string(300, 'x')}), "bad_reply");
}

TEST(Pce174Meter, SilenceIsNotAskedAgain) {
  StreamFake line(Answering({}));
  const auto reading = test::MeasuredOn(line, kMake);
  EXPECT_EQ(reading.error().code, "timeout");
  EXPECT_THAT(reading.error().message, HasSubstr("switches itself off"));
  EXPECT_THAT(line.writes(), ElementsAre(kRead));
}

TEST(Pce174Meter, UnpluggedInMidReplyIsUnplugged) {
  const auto speak = [](std::string&) { return Spoken{Reply().substr(0, 7), true}; };
  EXPECT_EQ(test::Measured(speak, kMake).error().code, "unplugged");
}

TEST(Pce174Meter, CtrlCEndsTheWaiting) {
  StreamFake line(Answering({"\xAA"}));
  Cancellation cancellation;
  test::CancelAtRead cancelling(line, cancellation, 2);
  const auto reading = kMake(cancelling, test::QuickSetup())->Measure(cancellation);
  EXPECT_EQ(reading.error().code, "interrupted");
}

TEST(Pce174Meter, WhatIsRecordedReplays) {
  test::ExpectReplaysToTheSame(Answering({"\xFF" + Reply()}), kMake);
  test::ExpectReplaysToTheSame(Answering({Reply("7F 7F"), Reply("28 01")}), kMake);
  test::ExpectReplaysToTheSame(Answering({Reply().substr(0, 4)}), kMake);
  test::ExpectReplaysToTheSame(Answering({}), kMake);
}

}  // namespace
}  // namespace lightcal::devices::pce174
