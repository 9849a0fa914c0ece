// SPDX-License-Identifier: Apache-2.0
// Folders as the kernel makes them; the first is the dump of a laptop in FedeDP/Clightd issue 34.
#include <gmock/gmock.h>

#include <cmath>

#include "fake_transport.h"
#include "lightcal_devices/meters/find_meters.h"
#include "lightcal_devices/meters/iio/frame.h"
#include "lightcal_devices/meters/iio/meter.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"
#include "lightcal_devices/transport/sysfs.h"
#include "run_cli.h"
#include "warning_codes.h"

namespace lightcal::devices::iio {
namespace {

using test::Codes;
using test::QuickSetup;
using test::TempDir;
using testing::ElementsAre;

using Files = std::map<std::string, std::string>;

const Files kLaptop = {{"name", "als\n"},
                       {"in_illuminance_raw", "209\n"},
                       {"in_illuminance_scale", "1.000000\n"},
                       {"in_illuminance_offset", "0\n"},
                       {"in_intensity_both_raw", "209\n"}};

void WriteAll(const TempDir& dir, const Files& files) {
  for (const auto& [name, text] : files) dir.Write("dev/" + name, text);
}

Result<MeterReading> Measured(const Files& files) {
  const TempDir dir;
  WriteAll(dir, files);
  const auto line = OpenSysfs(dir.path() + "/dev");
  return IioMeter(*line, QuickSetup()).Measure(Cancellation());
}

Files With(Files files, const Files& more) {
  for (const auto& [name, text] : more) files[name] = text;
  return files;
}

// A sensor that answers otherwise the second time, or fails at an attribute.
class ChangingTransport final : public Transport {
 public:
  ChangingTransport(std::vector<std::string> answers, std::string fault)
      : answers_(std::move(answers)), fault_(std::move(fault)) {}
  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds) override {
    asked_.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return {};
  }
  Result<Bytes> Read(std::size_t, std::chrono::milliseconds) override {
    if (asked_ != "in_illuminance_input") {
      return Failed(std::string(fault::kNoAttribute), Name(), "none");
    }
    ++reads_;
    if (reads_ > answers_.size()) return Failed(fault_, Name(), "as the test wishes");
    const auto bytes = AsBytes(answers_[reads_ - 1]);
    return Bytes(bytes.begin(), bytes.end());
  }
  [[nodiscard]] std::string Name() const override { return "fake"; }

 private:
  std::vector<std::string> answers_;
  std::string fault_;
  std::string asked_;
  std::size_t reads_ = 0;
};

TEST(IioFrame, NumbersAreWhatSysfsPrints) {
  EXPECT_EQ(DecodeNumber("209\n", "a")->value, 209.0);
  EXPECT_EQ(DecodeNumber("209\n", "a")->step, 1.0);
  EXPECT_EQ(DecodeNumber("0.010000\n", "a")->value, 0.01);
  EXPECT_NEAR(DecodeNumber("0.010000\n", "a")->step, 1e-6, 1e-18);
  EXPECT_EQ(DecodeNumber("-3", "a")->value, -3.0);
  for (const char* bad : {"", "\n", "nan", "1e5", "2 3", "0x10", "--1", "1.2.3", "12a",
                          "99999999999999999999", "1\n2"}) {
    const auto number = DecodeNumber(bad, "in_x");
    ASSERT_FALSE(number) << bad;
    EXPECT_EQ(number.error().code, kBadReply);
    EXPECT_EQ(number.error().subject, "in_x");
  }
}

TEST(IioFrame, AChannelIsItsInputOrRawPlusOffsetTimesScale) {
  EXPECT_EQ(ValueOf({.input = Number{5.0, 1.0},
                     .raw = Number{7.0, 1.0},
                     .offset = std::nullopt,
                     .scale = std::nullopt})
                ->value,
            5.0);
  const auto value = ValueOf({.input = std::nullopt,
                              .raw = Number{100.0, 1.0},
                              .offset = Number{4.0, 1.0},
                              .scale = Number{0.25, 1e-6}});
  EXPECT_EQ(value->value, 26.0);
  EXPECT_EQ(value->step, 0.25);
  EXPECT_FALSE(ValueOf(Channel{}));
}

TEST(IioMeter, TheLaptopOfTheDumpReads209Lux) {
  const auto reading = Measured(kLaptop);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 209.0);
  EXPECT_EQ(reading->reading.quality, MeterQuality::kBareSensor);
  EXPECT_EQ(reading->reading.device, "iio:als");
  EXPECT_NEAR(*reading->reading.sigma_relative, std::hypot(0.3, 1.0 / 209.0 / std::sqrt(12.0)),
              1e-12);
  EXPECT_FALSE(reading->reading.cct || reading->reading.xy);
  EXPECT_THAT(Codes(reading->warnings), testing::IsEmpty());
}

TEST(IioMeter, TheSecondOfTwoReadingsIsKept) {
  ChangingTransport line({"0\n", "120.5\n"}, "io");
  const auto reading = IioMeter(line, QuickSetup()).Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 120.5);
}

TEST(IioMeter, InputInLuxComesBeforeRaw) {
  EXPECT_EQ(
      Measured(With(kLaptop, {{"in_illuminance_input", "12.5\n"}}))->reading.illuminance->value(),
      12.5);
}

TEST(IioMeter, NoLightIsLessThanOneCount) {
  const auto reading = Measured(
      With(kLaptop, {{"in_illuminance_raw", "0\n"}, {"in_illuminance_scale", "0.100000\n"}}));
  EXPECT_TRUE(reading->reading.under_range);
  EXPECT_EQ(reading->reading.illuminance->value(), 0.1);
}

const Files kColour = With(kLaptop, {{"in_colortemp_raw", "3150\n"},
                                     {"in_chromaticity_x_raw", "4269\n"},
                                     {"in_chromaticity_y_raw", "3995\n"},
                                     {"in_chromaticity_scale", "0.000100\n"}});

TEST(IioMeter, ColourIsGivenWhenTheSensorHasIt) {
  const auto reading = Measured(kColour);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.cct->value(), 3150.0);
  EXPECT_NEAR(reading->reading.xy->x, 0.4269, 1e-12);
  EXPECT_NEAR(reading->reading.xy->y, 0.3995, 1e-12);
}

TEST(IioMeter, ColourThatIsNoneIsLeftOutWithAWarning) {
  for (const char* x : {"0\n", "12000\n", "-5\n"}) {
    const auto reading = Measured(With(kColour, {{"in_chromaticity_x_raw", x}}));
    EXPECT_FALSE(reading->reading.xy || reading->reading.cct) << x;
    EXPECT_THAT(Codes(reading->warnings), ElementsAre("bad_chromaticity"));
  }
  const auto reading = Measured(With(kColour, {{"in_colortemp_raw", "0\n"}}));
  EXPECT_FALSE(reading->reading.cct);
  EXPECT_TRUE(reading->reading.xy);
  EXPECT_THAT(Codes(reading->warnings), ElementsAre("cct_out_of_range"));
}

TEST(IioMeter, IntensityHasNoUnitAndIsNeverUsed) {
  EXPECT_EQ(Measured({{"name", "tsl"}, {"in_intensity_both_raw", "209\n"}}).error().code,
            fault::kNoAttribute);
}

TEST(IioMeter, DamagedFilesAndDeafSensorsAreTypedErrors) {
  EXPECT_EQ(Measured(With(kLaptop, {{"in_illuminance_raw", "garbage\n"}})).error().code, kBadReply);
  EXPECT_EQ(Measured(With(kLaptop, {{"in_illuminance_raw", "-7\n"}})).error().code, kBadReply);
  EXPECT_EQ(Measured({}).error().code, fault::kUnplugged);
  for (const auto* code : {"timeout", "io", "busy", "unplugged"}) {
    ChangingTransport line({"0\n"}, code);
    EXPECT_EQ(IioMeter(line, QuickSetup()).Measure(Cancellation()).error().code, code);
  }
}

TEST(IioMeter, ACancelledReadingSaysSo) {
  ChangingTransport line({"1\n", "1\n"}, "io");
  Cancellation cancellation;
  cancellation.Request();
  EXPECT_EQ(IioMeter(line, QuickSetup()).Measure(cancellation).error().code, "interrupted");
}

TEST(IioMeter, WhatWasRecordedPlaysAgain) {
  const TempDir dir;
  WriteAll(dir, kColour);
  const auto line = OpenSysfs(dir.path() + "/dev");
  Tape tape;
  tape.driver = "iio";
  RecordingTransport recording(*line, tape);
  const auto first = IioMeter(recording, QuickSetup()).Measure(Cancellation());
  ReplayTransport replay(tape);
  const auto again = IioMeter(replay, QuickSetup()).Measure(Cancellation());
  EXPECT_EQ(replay.Unconsumed(), 0U);
  EXPECT_EQ(first->reading.cct->value(), again->reading.cct->value());
}

}  // namespace
}  // namespace lightcal::devices::iio
