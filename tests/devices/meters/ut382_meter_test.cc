// SPDX-License-Identifier: Apache-2.0
// Listening, on a line in memory: no waiting, every fault.
#include "lightcal_devices/meters/display_meter.h"
#include "stream_meters.h"

namespace lightcal::devices::ut382 {
namespace {

using test::Hex;
using test::Measured;
using test::Saying;
using test::StreamFake;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr test::Make kMake = MakeDisplayMeter<kProtocol>;

// Nibble pairs of a frame and the byte after it, which means nothing to us.
std::string Frame(const std::string& pairs, const std::string& after = "00") {
  return Hex(pairs + " 0D 0A " + after);
}
const std::string kDigits1234 = "30 30 35 36 3C 3F 3E 35 30 36 30 30 30 30 30 30 30 30 ";
const std::string kSays123lx = Frame(kDigits1234 + "38 32 32 3E 30 30 30 30 30 30 30 30");
const std::string kBatteryLow = Frame(kDigits1234 + "38 33 32 3E 30 30 30 30 30 30 30 30");
const std::string kHold = Frame(kDigits1234 + "38 32 32 3E 30 31 30 30 30 30 30 30");
const std::string kMenu = Frame(
    "30 32 35 36 3C 3F 3E 35 30 36 30 30 30 30 30 30 30 30 38 32 32 3E 30 30 30 30 30 30 30 30");
const std::string kOverload = "30 30 30 30 3B 30 3B 37 30 30 30 30 30 30 30 30 30 30 38 32 ";
const std::string kOverloadAuto = Frame(kOverload + "32 3E 30 30 30 30 30 30 30 30");
const std::string kOverloadManual = Frame(kOverload + "30 38 30 30 30 30 30 30 30 30");

TEST(Ut382Meter, ReadsWhatTheDisplayShows) {
  const auto reading = Measured(Saying({kSays123lx}), kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  EXPECT_EQ(reading->reading.device, "ut382:UT382");
  EXPECT_EQ(reading->reading.quality, MeterQuality::kPhotometer);
  EXPECT_NEAR(*reading->reading.sigma_relative, 0.05, 1e-4);
  EXPECT_FALSE(reading->reading.cct);
  EXPECT_THAT(reading->warnings, IsEmpty());
}

TEST(Ut382Meter, NothingIsEverSentToIt) {
  StreamFake line(Saying({kSays123lx}));
  EXPECT_TRUE(test::MeasuredOn(line, kMake));
  EXPECT_THAT(line.writes(), IsEmpty());
}

TEST(Ut382Meter, JoinsTheStreamAnywhere) {
  for (std::size_t cut = 0; cut <= kSays123lx.size(); ++cut) {
    const auto reading =
        Measured(Saying({kSays123lx.substr(cut) + kSays123lx + kSays123lx}), kMake);
    ASSERT_TRUE(reading) << cut << reading.error().message;
    EXPECT_EQ(reading->reading.illuminance->value(), 123.4) << cut;
  }
}

// The byte after a frame is unknown: also one that looks like a frame's first must do no harm.
TEST(Ut382Meter, TheByteAfterAFrameMayBeAnything) {
  for (const std::string after : {"00", "30", "3F", "0D", "0A", "FF"}) {
    const std::string frame = Frame(kDigits1234 + "38 32 32 3E 30 30 30 30 30 30 30 30", after);
    StreamFake line(Saying({frame}));
    const auto meter = kMake(line, test::QuickSetup());
    for (int i = 0; i < 4; ++i) {
      const auto reading = meter->Measure(Cancellation());
      ASSERT_TRUE(reading) << after << ": " << reading.error().message;
      EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
    }
  }
}

TEST(Ut382Meter, WhatWasSentBeforeIsForgotten) {
  const std::string zero = Frame(
      "30 30 3B 37 3B 3F 30 30 30 30 30 30 30 30 30 30 30 30 38 32 32 3E 30 30 30 30 30 30 30 30");
  StreamFake line(Saying({kSays123lx}), zero + zero + zero);
  EXPECT_EQ(test::MeasuredOn(line, kMake)->reading.illuminance->value(), 123.4);
}

TEST(Ut382Meter, ADamagedFrameIsPassedOver) {
  std::string bad_digit = kSays123lx;
  bad_digit[2] = '\x31';
  std::string torn = kSays123lx.substr(0, 17);
  const auto reading = Measured(Saying({bad_digit, torn, kSays123lx}), kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
}

TEST(Ut382Meter, NoiseEndsAfterABoundedNumberOfBytes) {
  StreamFake line(Saying({std::string(64, 'x')}));
  const auto reading = test::MeasuredOn(line, kMake);
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, "bad_reply");
  EXPECT_LT(line.reads(), 20);
}

TEST(Ut382Meter, EndlessDamagedFramesEndToo) {
  std::string bad_digit = kSays123lx;
  bad_digit[2] = '\x31';
  StreamFake line(Saying({bad_digit}));
  EXPECT_EQ(test::MeasuredOn(line, kMake).error().code, "bad_reply");
  EXPECT_LT(line.reads(), 60);
}

TEST(Ut382Meter, SilenceSaysHowToSwitchItsUsbOn) {
  const auto reading = Measured(Saying({}), kMake);
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, "timeout");
  EXPECT_THAT(reading.error().message, HasSubstr("switch the meter's USB on"));
}

TEST(Ut382Meter, AFrozenDisplayIsRefusedByItsName) {
  const auto reading = Measured(Saying({kHold}), kMake);
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, "hold");
  EXPECT_THAT(reading.error().message, HasSubstr("HOLD"));
}

TEST(Ut382Meter, AMenuIsWaitedForAndThenNamed) {
  EXPECT_TRUE(Measured(Saying({kMenu, kMenu, kSays123lx}), kMake));
  EXPECT_EQ(Measured(Saying({kMenu}), kMake).error().code, "in_menu");
}

TEST(Ut382Meter, OverloadOnTheHighestRangeIsACensoredReading) {
  const auto reading = Measured(Saying({kOverloadAuto}), kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_TRUE(reading->reading.over_range);
  EXPECT_EQ(reading->reading.illuminance->value(), 20000.0);
}

TEST(Ut382Meter, OverloadOnARangeChosenByHandIsNoNumberAtAll) {
  EXPECT_EQ(Measured(Saying({kOverloadManual}), kMake).error().code, "overload");
}

TEST(Ut382Meter, ALowBatteryWarns) {
  EXPECT_THAT(test::CodesOf(*Measured(Saying({kBatteryLow}), kMake)), ElementsAre("battery_low"));
}

TEST(Ut382Meter, UnpluggedInMidFrameIsUnplugged) {
  const auto speak = [](std::string&) { return test::Spoken{kSays123lx.substr(0, 11), true}; };
  EXPECT_EQ(Measured(speak, kMake).error().code, "unplugged");
}

TEST(Ut382Meter, CtrlCEndsTheListening) {
  StreamFake line(Saying({kMenu}));
  Cancellation cancellation;
  test::CancelAtRead cancelling(line, cancellation, 3);
  const auto reading = kMake(cancelling, test::QuickSetup())->Measure(cancellation);
  EXPECT_EQ(reading.error().code, "interrupted");
}

TEST(Ut382Meter, WhatIsRecordedReplays) {
  test::ExpectReplaysToTheSame(Saying({kSays123lx.substr(9), kSays123lx}), kMake);
  test::ExpectReplaysToTheSame(Saying({kMenu, kSays123lx.substr(0, 5), kOverloadAuto}), kMake);
  test::ExpectReplaysToTheSame(Saying({}), kMake);
  test::ExpectReplaysToTheSame(Saying({std::string(40, 'x')}), kMake);
}

}  // namespace
}  // namespace lightcal::devices::ut382
