// SPDX-License-Identifier: Apache-2.0
// Truth: the figures the two captured replies are known for (sample_data/sekonic_replies;
// skreader's own tests decode the same bytes), and the replies' agreement with themselves.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "fake_sekonic.h"
#include "lightcal_devices/meters/sekonic/frame.h"
#include "lightcal_devices/meters/sekonic/reading.h"
#include "warning_codes.h"

namespace lightcal::devices::sekonic {
namespace {

using test::Codes;
using test::RecordedReply;
using test::WithByte;
using test::WithFloat;

constexpr std::size_t kLuxAt = 271;
constexpr std::size_t kFootcandleAt = 276;
constexpr std::size_t kCctAt = 50;
constexpr std::size_t kDuvAt = 55;

std::vector<std::byte> Text(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Measurement Decoded(const std::vector<std::byte>& reply) {
  const auto m = DecodeMeasurement(reply);
  EXPECT_TRUE(m) << m.error().message;
  return m.value_or(Measurement{});
}

TEST(SekonicFrame, TheFirstCapturedReplyIs407LuxAt4995Kelvin) {
  const Measurement m = Decoded(RecordedReply(test::kReply407lx));
  EXPECT_NEAR(m.illuminance_lx, 406.960, 5e-4);
  EXPECT_NEAR(m.cct_K, 4995.02, 5e-3);
  EXPECT_NEAR(m.duv, -0.00110, 5e-6);
  EXPECT_NEAR(m.xy.x, 0.345044, 5e-7);
  EXPECT_NEAR(m.xy.y, 0.349401, 5e-7);
  EXPECT_NEAR(m.cri_Ra, 98.38, 5e-3);
}

TEST(SekonicFrame, TheSecondCapturedReplyIs14LuxAt3289Kelvin) {
  const Measurement m = Decoded(RecordedReply(test::kReply14lx));
  EXPECT_NEAR(m.illuminance_lx, 14.0775, 5e-5);
  EXPECT_NEAR(m.cct_K, 3288.61, 5e-3);
  EXPECT_NEAR(m.duv, 8.56e-5, 5e-8);
  EXPECT_NEAR(m.xy.x, 0.417863, 5e-7);
  EXPECT_NEAR(m.xy.y, 0.396824, 5e-7);
  EXPECT_NEAR(m.cri_Ra, 88.08, 5e-3);
}

TEST(SekonicFrame, CapturedRepliesAgreeWithThemselves) {
  for (const char* name : {test::kReply407lx, test::kReply14lx}) {
    EXPECT_THAT(Codes(SelfCheck(Decoded(RecordedReply(name)), "m")), testing::IsEmpty()) << name;
  }
}

TEST(SekonicFrame, AFloatBecomesTheDecimalThatIsIt) {
  const Measurement m = Decoded(WithFloat(RecordedReply(test::kReply407lx), kLuxAt, 406.96F));
  EXPECT_EQ(m.illuminance_lx, 406.96);
}

TEST(SekonicFrame, EachDamagedValueFailsItsOwnSelfCheck) {
  const auto reply = RecordedReply(test::kReply407lx);
  const auto warned = [](const std::vector<std::byte>& bytes) {
    std::string all;
    for (const Warning& w : SelfCheck(Decoded(bytes), "m")) all += w.code + ":" + w.message + "\n";
    return all;
  };
  EXPECT_THAT(warned(WithFloat(reply, kFootcandleAt, 37.0F)), testing::HasSubstr("foot-candles"));
  EXPECT_THAT(warned(WithFloat(reply, kLuxAt, 407.5F)), testing::HasSubstr("another Y"));
  EXPECT_THAT(warned(WithFloat(reply, 308, 0.35F)), testing::HasSubstr("different colours"));
  // One sample near the peak of ybar, wrong by 0.1 W m-2 nm-1, is 68 lx.
  EXPECT_THAT(warned(WithFloat(reply, 753 + 4 * 175, 0.1F)), testing::HasSubstr("integrates to"));
}

TEST(SekonicFrame, AReplyOfAnotherLengthIsRefused) {
  auto reply = RecordedReply(test::kReply407lx);
  reply.pop_back();
  EXPECT_EQ(DecodeMeasurement(reply).error().code, kBadReply);
  reply.resize(kMeasurementBytes + 1);
  EXPECT_EQ(DecodeMeasurement(reply).error().code, kBadReply);
  EXPECT_EQ(DecodeMeasurement({}).error().code, kBadReply);
}

TEST(SekonicFrame, EveryCommaAndTheEchoAreChecked) {
  const auto reply = RecordedReply(test::kReply407lx);
  for (const std::size_t at :
       {0, 1, 6, 23, 49, 54, 270, 275, 280, 289, 298, 307, 312, 347, 427, 752}) {
    const auto m = DecodeMeasurement(WithByte(reply, at, std::byte{0x7E}));
    ASSERT_FALSE(m) << at;
    EXPECT_EQ(m.error().code, kBadReply) << at;
  }
}

TEST(SekonicFrame, AnIlluminanceThatIsNoNumberIsRefused) {
  const auto reply = RecordedReply(test::kReply407lx);
  for (const float lux :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0F}) {
    EXPECT_FALSE(DecodeMeasurement(WithFloat(reply, kLuxAt, lux)));
  }
}

TEST(SekonicFrame, AcknowledgementsAreYesNoOrDamaged) {
  EXPECT_TRUE(DecodeAcknowledge(Text("\x06\x30")));
  EXPECT_EQ(DecodeAcknowledge(Text("\x15\x32")).error().code, "nak");
  EXPECT_EQ(DecodeAcknowledge(Text("\x06")).error().code, kBadReply);
  EXPECT_EQ(DecodeAcknowledge(Text("\x06\x30\x30")).error().code, kBadReply);
  EXPECT_EQ(DecodeAcknowledge({}).error().code, kBadReply);
}

TEST(SekonicFrame, TheModelEndsAtItsFirstNul) {
  using std::string_view_literals::operator""sv;
  EXPECT_EQ(*DecodeModel(Text("MN@@@C-7000\0\0junk"sv)), "C-7000");
  EXPECT_EQ(*DecodeModel(Text("MN@@ C-800"sv)), "C-800");
  EXPECT_FALSE(DecodeModel(Text("MN@@@\0\0"sv)));
  EXPECT_FALSE(DecodeModel(Text("MN@@@"sv)));
}

TEST(SekonicFrame, TheMainFirmwareIsTheThirdField) {
  EXPECT_EQ(DecodeFirmware(Text("FV@@@20,C36E,27,7881,11,B216"))->main, 27);
  EXPECT_EQ(DecodeFirmware(Text("FV@@@120,C36E,9"))->main, 9);
  EXPECT_FALSE(DecodeFirmware(Text("FV@@@20,C36E")));
  EXPECT_FALSE(DecodeFirmware(Text("FV@@@20,C36E,x")));
}

TEST(SekonicFrame, TheStateTellsRingButtonAndWhatTheMeterDoes) {
  const auto state = [](unsigned s1, unsigned s2, unsigned key) {
    return *DecodeState(
        std::vector{std::byte{'S'}, std::byte{'T'}, std::byte(s1), std::byte(s2), std::byte(key)});
  };
  EXPECT_EQ(state(0x40, 0x40, 0x40).activity, Activity::kIdle);
  EXPECT_EQ(state(0x40, 0x40, 0x40).ring, Ring::kLow);
  EXPECT_EQ(state(0x48, 0x40, 0x40).activity, Activity::kIdle);  // idle outside a measurement
  EXPECT_EQ(state(0x41, 0x48, 0x40).doing, "measuring");
  EXPECT_EQ(state(0x41, 0x44, 0x40).doing, "calibrating its dark signal");
  EXPECT_EQ(state(0x50, 0x40, 0x40).activity, Activity::kHardwareError);
  EXPECT_TRUE(state(0x42, 0x40, 0x40).remote);
  EXPECT_TRUE(state(0x40, 0x40, 0x42).measure_button_held);
  EXPECT_EQ(state(0x40, 0x40, 0x60).ring, Ring::kHigh);
  EXPECT_EQ(state(0x40, 0x40, 0x20).ring, Ring::kCalibration);
  EXPECT_EQ(state(0x40, 0x40, 0x00).ring, Ring::kUnpositioned);
  EXPECT_TRUE(state(0x48, 0x40, 0x40).outside_measurement);
  EXPECT_FALSE(state(0x40, 0x40, 0x40).outside_measurement);
  EXPECT_TRUE(state(0x41, 0x44, 0x40).calibrating_dark);
  EXPECT_FALSE(state(0x41, 0x45, 0x40).calibrating_dark);  // it still initialises
  EXPECT_FALSE(state(0x40, 0x44, 0x40).calibrating_dark);  // idle: the second byte means nothing
  EXPECT_EQ(RingName(Ring::kHigh), "at HIGH");
  EXPECT_FALSE(DecodeState(Text("ST@@")));
}

TEST(SekonicFrame, AStoredMeasurementIsLaidOutAsAFreshOne) {
  auto reply = RecordedReply(test::kReply407lx);
  EXPECT_EQ(DecodeStoredMeasurement(reply).error().code, kBadReply);  // it answers NR
  reply[0] = std::byte{'M'};
  EXPECT_NEAR(DecodeStoredMeasurement(reply)->illuminance_lx, 406.960, 5e-4);
  EXPECT_EQ(DecodeMeasurement(reply).error().code, kBadReply);
  reply.pop_back();
  EXPECT_EQ(DecodeStoredMeasurement(reply).error().code, kBadReply);
}

TEST(SekonicFrame, TheMemorysSizeIsItsSecondField) {
  EXPECT_EQ(*DecodeMemoryInfo(Text("MIB@@0,12,3")), 12);
  EXPECT_EQ(*DecodeMemoryInfo(Text("MIB@@0,0")), 0);
  for (const char* bad : {"MIB@@", "MIB@@12", "MIB@@0,x,3", "MIB@@0,-1,3", "MIB@@0,1.5,3",
                          "MIB@@0,99999,3", "NRB@@0,12,3", ""}) {
    EXPECT_EQ(DecodeMemoryInfo(Text(bad)).error().code, kBadReply) << bad;
  }
  EXPECT_EQ(StoredMeasurementCommand(7), "MR0007");
  EXPECT_EQ(StoredMeasurementCommand(kMostStored), "MR9999");
}

TEST(SekonicReading, BelowOneLuxIsALimitAndNoNumber) {
  Measurement m = Decoded(RecordedReply(test::kReply14lx));
  m.illuminance_lx = 0.99;
  const MeterReading r = ReadingFromMeasurement(m, "s:1");
  EXPECT_TRUE(r.reading.under_range);
  EXPECT_EQ(r.reading.illuminance->value(), 1.0);
  EXPECT_FALSE(r.reading.xy || r.reading.cct || r.spectrum);
  m.illuminance_lx = 1.0;
  EXPECT_FALSE(ReadingFromMeasurement(m, "s:1").reading.under_range);
}

TEST(SekonicReading, CarriesColorSpectrumAndTheMetersSigma) {
  const MeterReading r = ReadingFromMeasurement(Decoded(RecordedReply(test::kReply407lx)), "s:1");
  EXPECT_NEAR(r.reading.illuminance->value(), 406.960, 5e-4);
  EXPECT_NEAR(r.reading.cct->value(), 4995.02, 5e-3);
  EXPECT_EQ(r.reading.sigma_relative, 0.05);
  EXPECT_EQ(r.reading.color_source, ColorSource::kSpectrometer);
  EXPECT_EQ(r.reading.device, "s:1");
  ASSERT_TRUE(r.spectrum);
  EXPECT_EQ(r.spectrum->values.size(), 401U);
  EXPECT_EQ(r.spectrum->wavelengths_nm.back(), 780.0);
  EXPECT_EQ(r.cri_R.size(), 15U);
  EXPECT_THAT(r.warnings, testing::IsEmpty());
}

TEST(SekonicReading, BelowFiveLuxColorIsAbsentWithAWarning) {
  Measurement m = Decoded(RecordedReply(test::kReply14lx));
  m.illuminance_lx = 4.9;
  m.illuminance_fc = 4.9 / 10.76391;
  m.xyz.Y = 4.9;
  const MeterReading r = ReadingFromMeasurement(m, "s:1");
  EXPECT_EQ(r.reading.illuminance->value(), 4.9);
  EXPECT_FALSE(r.reading.xy || r.reading.cct || r.reading.duv || r.spectrum || r.cri_Ra);
  EXPECT_EQ(r.reading.color_source, ColorSource::kUnknown);
  EXPECT_THAT(Codes(r.warnings), testing::ElementsAre("low_light_color"));
}

TEST(SekonicReading, CctOutsideTheMetersRangeIsAbsentButXyStays) {
  const auto reply = RecordedReply(test::kReply407lx);
  const auto codes_and_cct = [](const std::vector<std::byte>& bytes) {
    const MeterReading r = ReadingFromMeasurement(Decoded(bytes), "s:1");
    EXPECT_TRUE(r.reading.xy);
    EXPECT_FALSE(r.reading.cct || r.reading.duv);
    return Codes(r.warnings);
  };
  const auto expected = testing::ElementsAre("cct_out_of_range");
  EXPECT_THAT(codes_and_cct(WithFloat(reply, kCctAt, 1562.0F)), expected);
  EXPECT_THAT(codes_and_cct(WithFloat(reply, kCctAt, 100001.0F)), expected);
  EXPECT_THAT(codes_and_cct(WithFloat(reply, kCctAt, 50000.0F)), expected);
  EXPECT_THAT(codes_and_cct(WithFloat(reply, kDuvAt, -0.11F)), expected);
  EXPECT_THAT(codes_and_cct(WithFloat(reply, kCctAt, NAN)), expected);
}

TEST(SekonicReading, Above200000LuxIsOverRange) {
  Measurement m = Decoded(RecordedReply(test::kReply407lx));
  EXPECT_FALSE(ReadingFromMeasurement(m, "s:1").reading.over_range);
  m.illuminance_lx = 200001.0;
  const MeterReading r = ReadingFromMeasurement(m, "s:1");
  EXPECT_TRUE(r.reading.over_range);
  EXPECT_FALSE(r.reading.cct);
}

}  // namespace
}  // namespace lightcal::devices::sekonic
