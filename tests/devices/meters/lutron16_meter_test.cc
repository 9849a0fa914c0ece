// SPDX-License-Identifier: Apache-2.0
// Listening, on a line in memory: no waiting, every fault.
#include "lightcal_devices/meters/display_meter.h"
#include "stream_meters.h"

namespace lightcal::devices::lutron16 {
namespace {

using test::Hex;
using test::Measured;
using test::Saying;
using test::StreamFake;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr test::Make kMake = MakeDisplayMeter<kProtocol>;

const std::string kSays123lx = Hex("02 34 31 31 35 30 31 30 30 30 30 31 32 33 34 0D");
const std::string kLower =
    "\x02"
    "42010100000253\r";
const std::string kDecibels =
    "\x02"
    "41170100001234\r";
const std::string kNegative =
    "\x02"
    "41151100000003\r";

std::string CodeOf(std::vector<std::string> frames) {
  const auto reading = Measured(Saying(std::move(frames)), kMake);
  return reading ? "" : reading.error().code;
}

TEST(Lutron16Meter, ReadsWhatTheDisplayShows) {
  StreamFake line(Saying({kSays123lx}));
  const auto reading = test::MeasuredOn(line, kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  EXPECT_EQ(reading->reading.device, "lutron16:Lutron");
  EXPECT_EQ(reading->reading.quality, MeterQuality::kPhotometer);
  EXPECT_THAT(line.writes(), IsEmpty()) << "the meter only sends";
}

TEST(Lutron16Meter, JoinsTheStreamAnywhere) {
  for (std::size_t cut = 0; cut <= kSays123lx.size(); ++cut) {
    const auto reading = Measured(Saying({kSays123lx.substr(cut), kSays123lx}), kMake);
    ASSERT_TRUE(reading) << cut << reading.error().message;
    EXPECT_EQ(reading->reading.illuminance->value(), 123.4) << cut;
  }
}

TEST(Lutron16Meter, NoiseAndATornFrameBeforeItDoNoHarm) {
  for (const std::string& before : {std::string("\xFF\x02"), kSays123lx.substr(0, 9),
                                    std::string("\x02\x34\x02\x34"), std::string("\r\r")}) {
    const auto reading = Measured(Saying({before + kSays123lx}), kMake);
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  }
}

TEST(Lutron16Meter, WhatWasSentBeforeIsForgotten) {
  StreamFake line(Saying({kSays123lx}), kNegative + kNegative);
  EXPECT_EQ(test::MeasuredOn(line, kMake)->reading.illuminance->value(), 123.4);
}

TEST(Lutron16Meter, TheLowerDisplayIsPassedOver) {
  EXPECT_EQ(Measured(Saying({kLower, kSays123lx}), kMake)->reading.illuminance->value(), 123.4);
  EXPECT_EQ(CodeOf({kLower}), "no_light_display");
}

TEST(Lutron16Meter, AnotherUnitIsNamedAtOnce) {
  StreamFake line(Saying({kDecibels}));
  const auto reading = test::MeasuredOn(line, kMake);
  EXPECT_EQ(reading.error().code, "wrong_unit");
  EXPECT_THAT(reading.error().message, HasSubstr("code 17"));
  EXPECT_LT(line.reads(), 4);
}

TEST(Lutron16Meter, LessThanNoLightIsRefused) {
  EXPECT_EQ(CodeOf({kNegative}), "negative_reading");
}

TEST(Lutron16Meter, AboveTheFamilysHighestRangeItIsCensored) {
  const auto reading = Measured(Saying({"\x02"
                                        "41150000100001\r"}),
                                kMake);
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->reading.over_range);
  EXPECT_EQ(reading->reading.illuminance->value(), 100000.0);
}

TEST(Lutron16Meter, DashesAreNoNumber) {
  const auto reading = Measured(Saying({"\x02"
                                        "411500----    \r"}),
                                kMake);
  EXPECT_EQ(reading.error().code, "bad_reply");
  EXPECT_THAT(reading.error().message, HasSubstr("dashes"));
}

TEST(Lutron16Meter, NoiseEndsAfterABoundedNumberOfBytes) {
  StreamFake line(Saying({std::string(64, 'x')}));
  EXPECT_EQ(test::MeasuredOn(line, kMake).error().code, "bad_reply");
  EXPECT_LT(line.reads(), 20);
}

TEST(Lutron16Meter, SilenceNamesTheCable) {
  const auto reading = Measured(Saying({}), kMake);
  EXPECT_EQ(reading.error().code, "timeout");
  EXPECT_THAT(reading.error().message, HasSubstr("resistor"));
}

TEST(Lutron16Meter, UnpluggedInMidFrameIsUnplugged) {
  const auto speak = [](std::string&) { return test::Spoken{kSays123lx.substr(0, 11), true}; };
  EXPECT_EQ(Measured(speak, kMake).error().code, "unplugged");
}

TEST(Lutron16Meter, CtrlCEndsTheListening) {
  StreamFake line(Saying({}));
  Cancellation cancellation;
  test::CancelAtRead cancelling(line, cancellation, 2);
  const auto reading = kMake(cancelling, test::QuickSetup())->Measure(cancellation);
  EXPECT_EQ(reading.error().code, "interrupted");
}

TEST(Lutron16Meter, WhatIsRecordedReplays) {
  test::ExpectReplaysToTheSame(Saying({kSays123lx.substr(5), kLower, kSays123lx}), kMake);
  test::ExpectReplaysToTheSame(Saying({kDecibels}), kMake);
  test::ExpectReplaysToTheSame(Saying({kSays123lx.substr(0, 5), ""}), kMake);
  test::ExpectReplaysToTheSame(Saying({}), kMake);
}

}  // namespace
}  // namespace lightcal::devices::lutron16
