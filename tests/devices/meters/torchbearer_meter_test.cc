// SPDX-License-Identifier: Apache-2.0
// The dialogue, on a line in memory: no waiting, every fault. Truth of the colour: CIE illuminant
// A, x = 0.44758, y = 0.40745 (CIE 15:2018, table 1), whose temperature is 2856 K.
#include "fake_torchbearer.h"
#include "lightcal_devices/meters/torchbearer/meter.h"
#include "lightcal_devices/meters/torchbearer/reading.h"
#include "stream_meters.h"

namespace lightcal::devices::torchbearer {
namespace {

using test::Exposed;
using test::FakeTorchbearer;
using test::Hex;
using test::IlluminantA;
using test::StreamFake;
using test::TorchSetting;
using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

const std::string kId = Hex("CC 01 0A 00 00 08 18 F7 0D 0A");
const std::string kRange = Hex("CC 01 09 00 00 0F E5 0D 0A");
const std::string kGetExposure = Hex("CC 01 09 00 00 0B E1 0D 0A");
const std::string kAutomatic = Hex("CC 01 0A 00 00 0A 01 E2 0D 0A");
const std::string kManual = Hex("CC 01 0A 00 00 0A 00 E1 0D 0A");
const std::string kData = Hex("CC 01 09 00 00 33 09 0D 0A");
const std::string kStop = Hex("CC 01 09 00 00 04 DA 0D 0A");

TorchSetting Lamp() {
  TorchSetting setting;
  setting.measurements = {IlluminantA()};
  return setting;
}

TorchSetting Faulty(unsigned type, const std::string& instead, int times = 1000) {
  TorchSetting setting = Lamp();
  setting.faulty_type = type;
  setting.instead = instead;
  setting.times = times;
  return setting;
}

TEST(TorchbearerMeter, MeasuresIlluminantA) {
  StreamFake line{FakeTorchbearer(Lamp())};
  const auto reading = test::MeasuredOn(line, MakeMeter);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.device, "torchbearer:Y21B7W-0042");
  EXPECT_EQ(reading->reading.quality, MeterQuality::kSpectral);
  EXPECT_NEAR(reading->reading.xy->x, 0.44758, 2e-5);
  EXPECT_NEAR(reading->reading.xy->y, 0.40745, 2e-5);
  EXPECT_NEAR(reading->reading.cct->value(), 2856.0, 1.0);
  EXPECT_NEAR(*reading->reading.duv, 0.0, 2e-5);
  EXPECT_EQ(reading->reading.color_source, ColorSource::kSpectrometer);
  ASSERT_TRUE(reading->spectrum);
  EXPECT_EQ(reading->spectrum->wavelengths_nm.front(), 340.0);
  EXPECT_EQ(reading->spectrum->wavelengths_nm.back(), 1050.0);
  EXPECT_THAT(test::CodesOf(*reading), ElementsAre("experimental"));
  EXPECT_THAT(line.writes(), ElementsAre(kId, kRange, kGetExposure, kData, kStop));
}

// E = 683 lm/W sum V E_lambda dl, with V from its published values at the three lines' wavelengths.
TEST(TorchbearerMeter, IlluminanceIsTheSumUnderV) {
  TorchSetting setting = Lamp();
  auto& samples = setting.measurements[0].samples;
  std::ranges::fill(samples, std::uint16_t{0});
  samples[555 - 340] = 10000;  // 0.01 W m^-2 nm^-1 for 1 nm, V = 1.0000
  samples[510 - 340] = 20000;  // V = 0.5030
  samples[650 - 340] = 30000;  // V = 0.1070
  const auto reading = test::Measured(FakeTorchbearer(setting), MakeMeter);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(),
              683.002 * (0.01 * 1.0 + 0.02 * 0.5030 + 0.03 * 0.1070), 1e-3);
  EXPECT_THAT(test::CodesOf(*reading), Contains("cct_out_of_range"));
}

TEST(TorchbearerMeter, DarknessIsNoLuxAndNoColor) {
  TorchSetting setting = Lamp();
  std::ranges::fill(setting.measurements[0].samples, std::uint16_t{0});
  const auto reading = test::Measured(FakeTorchbearer(setting), MakeMeter);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 0.0);
  EXPECT_FALSE(reading->reading.xy || reading->reading.cct);
}

TEST(TorchbearerMeter, ARangeShortOfTheVisibleWarns) {
  const Measurement measurement{Exposure::kOk, 1.0, std::vector<double>(201, 0.001)};
  EXPECT_THAT(test::CodesOf(ReadingFromMeasurement(measurement, {450, 650}, "t:1")),
              Contains("spectrum_range"));
}

TEST(TorchbearerMeter, AManualExposureIsMadeAutomaticAndGivenBack) {
  TorchSetting setting = Lamp();
  setting.automatic = false;
  StreamFake line{FakeTorchbearer(setting)};
  ASSERT_TRUE(test::MeasuredOn(line, MakeMeter));
  EXPECT_THAT(line.writes(),
              ElementsAre(kId, kRange, kGetExposure, kAutomatic, kData, kStop, kManual));
}

TEST(TorchbearerMeter, IsAskedForItsIdAndRangeOnce) {
  StreamFake line{FakeTorchbearer(Lamp())};
  const auto meter = MakeMeter(line, test::QuickSetup());
  EXPECT_EQ(meter->Identify()->model, "Y21B7W-0042");
  EXPECT_TRUE(meter->Measure(Cancellation()));
  EXPECT_TRUE(meter->Measure(Cancellation()));
  EXPECT_THAT(line.writes(),
              ElementsAre(kId, kRange, kGetExposure, kData, kStop, kGetExposure, kData, kStop));
}

TEST(TorchbearerMeter, WaitsUntilTheAutomaticExposureFits) {
  TorchSetting setting;
  setting.measurements = {Exposed(1), Exposed(1), Exposed(2), IlluminantA()};
  EXPECT_TRUE(test::Measured(FakeTorchbearer(setting), MakeMeter));
}

TEST(TorchbearerMeter, ALightBeyondEveryExposureIsRefusedAndTheStreamEnded) {
  for (const auto& [status, code] : {std::pair{1U, "over_exposed"}, {2U, "under_exposed"}}) {
    TorchSetting setting;
    setting.measurements = {Exposed(status)};
    setting.automatic = false;
    StreamFake line{FakeTorchbearer(setting)};
    const auto reading = test::MeasuredOn(line, MakeMeter);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().code, code);
    EXPECT_EQ(reading.error().kind, ErrorKind::kRefused);
    EXPECT_THAT(line.received(), EndsWith(kStop + kManual));
  }
}

TEST(TorchbearerMeter, ADamagedMeasurementIsPassedOverOnceAndOnlyOnce) {
  std::string damaged = test::AsText(test::TorchMessage(0x33, test::TorchData(IlluminantA())));
  damaged[100] = static_cast<char>(damaged[100] ^ 1);
  StreamFake once{FakeTorchbearer(Faulty(0x33, damaged, 1))};
  EXPECT_TRUE(test::MeasuredOn(once, MakeMeter));
  StreamFake always{FakeTorchbearer(Faulty(0x33, damaged))};
  const auto reading = test::MeasuredOn(always, MakeMeter);
  EXPECT_EQ(reading.error().code, "bad_reply");
  EXPECT_THAT(reading.error().message, HasSubstr("sum"));
  EXPECT_THAT(always.received(), EndsWith(kStop));
}

TEST(TorchbearerMeter, ADamagedAnswerIsAskedForOnceMore) {
  std::string damaged = test::AsText(test::TorchMessage(0x0F, test::TorchRange(340, 1050)));
  damaged[6] = '\x7F';
  StreamFake once{FakeTorchbearer(Faulty(0x0F, damaged, 1))};
  EXPECT_TRUE(test::MeasuredOn(once, MakeMeter));
  StreamFake always{FakeTorchbearer(Faulty(0x0F, damaged))};
  EXPECT_EQ(test::MeasuredOn(always, MakeMeter).error().code, "bad_reply");
  EXPECT_THAT(always.writes(), ElementsAre(kId, kRange, kRange));
}

TEST(TorchbearerMeter, NoiseBeforeAnAnswerDoesNoHarm) {
  const std::string answer = test::AsText(test::TorchMessage(0x0F, test::TorchRange(340, 1050)));
  EXPECT_TRUE(
      test::Measured(FakeTorchbearer(Faulty(0x0F, "\xCC\x01\xFFnoise" + answer)), MakeMeter));
}

TEST(TorchbearerMeter, ARefusedOrderIsNamed) {
  TorchSetting setting = Faulty(0x0A, test::AsText(test::TorchMessage(0x0A, {std::byte{1}})));
  setting.automatic = false;
  EXPECT_EQ(test::Measured(FakeTorchbearer(setting), MakeMeter).error().code, "nak");
}

// The acknowledgement of an earlier end may come late and end the stream that has just begun.
TEST(TorchbearerMeter, AStreamEndedByALateAcknowledgementIsBegunAgain) {
  const std::string late = test::AsText(test::TorchMessage(0x04, {}));
  StreamFake line{FakeTorchbearer(Faulty(0x33, late, 1))};
  ASSERT_TRUE(test::MeasuredOn(line, MakeMeter));
  EXPECT_THAT(line.writes(), ElementsAre(kId, kRange, kGetExposure, kData, kData, kStop));
}

TEST(TorchbearerMeter, SilenceIsATimeoutAtEveryStep) {
  for (const unsigned type : {0x08U, 0x0FU, 0x0BU, 0x33U}) {
    const auto reading = test::Measured(FakeTorchbearer(Faulty(type, "")), MakeMeter);
    ASSERT_FALSE(reading) << type;
    EXPECT_EQ(reading.error().code, "timeout") << type;
  }
}

TEST(TorchbearerMeter, AReadingSurvivesAnEndThatIsNotAcknowledged) {
  TorchSetting setting = Lamp();
  setting.acknowledges_stop = false;
  const auto reading = test::Measured(FakeTorchbearer(setting), MakeMeter);
  ASSERT_TRUE(reading);
  EXPECT_THAT(test::CodesOf(*reading), ElementsAre("experimental", "not_restored"));
}

TEST(TorchbearerMeter, UnpluggedInMidMessageIsNotSpokenToAgain) {
  const std::string half =
      test::AsText(test::TorchMessage(0x33, test::TorchData(IlluminantA()))).substr(0, 300);
  TorchSetting setting = Faulty(0x33, half);
  setting.pulls_the_plug = true;
  StreamFake line{FakeTorchbearer(setting)};
  EXPECT_EQ(test::MeasuredOn(line, MakeMeter).error().code, "unplugged");
  EXPECT_THAT(line.received(), EndsWith(kData));
}

TEST(TorchbearerMeter, CtrlCEndsTheStream) {
  TorchSetting setting;
  setting.measurements = {Exposed(1)};
  StreamFake line{FakeTorchbearer(setting)};
  Cancellation cancellation;
  test::CancelAtRead cancelling(line, cancellation, 16);
  const auto reading = MakeMeter(cancelling, test::QuickSetup())->Measure(cancellation);
  EXPECT_EQ(reading.error().code, "interrupted");
  EXPECT_THAT(line.received(), EndsWith(kStop));
}

TEST(TorchbearerMeter, WhatIsRecordedReplays) {
  test::ExpectReplaysToTheSame(FakeTorchbearer(Lamp()), MakeMeter);
  TorchSetting over;
  over.measurements = {Exposed(1)};
  test::ExpectReplaysToTheSame(FakeTorchbearer(over), MakeMeter);
  test::ExpectReplaysToTheSame(FakeTorchbearer(Faulty(0x0F, "")), MakeMeter);
  test::ExpectReplaysToTheSame(FakeTorchbearer(Faulty(0x33, "\xCC\x81", 1)), MakeMeter);
}

}  // namespace
}  // namespace lightcal::devices::torchbearer
