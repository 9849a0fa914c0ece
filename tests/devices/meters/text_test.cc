// SPDX-License-Identifier: Apache-2.0
// Lines as readings, and the driver over them, in memory.
#include "lightcal_devices/transport/text.h"

#include <gmock/gmock.h>

#include <deque>

#include "fake_transport.h"
#include "lightcal_devices/meters/text/meter.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"

namespace lightcal::devices::text {
namespace {

using test::QuickSetup;
using testing::HasSubstr;

struct LineCase {
  const char* line;
  double illuminance_lx;
  double cct_K;  // 0 = none
};
class TextLine : public testing::TestWithParam<LineCase> {};
TEST_P(TextLine, IsAnIlluminanceAndPerhapsAColourTemperature) {
  const auto reading = DecodeLine(GetParam().line);
  ASSERT_TRUE(reading) << reading.error().message;
  ASSERT_TRUE(*reading);
  EXPECT_DOUBLE_EQ((*reading)->illuminance.value(), GetParam().illuminance_lx);
  EXPECT_EQ((*reading)->cct ? (*reading)->cct->value() : 0.0, GetParam().cct_K);
}
INSTANTIATE_TEST_SUITE_P(
    TextFrame, TextLine,
    testing::Values(LineCase{"192", 192, 0}, LineCase{"  192.5\r", 192.5, 0},
                    LineCase{"192lx", 192, 0}, LineCase{"192 lux", 192, 0},
                    LineCase{"1.2klx", 1200, 0}, LineCase{"0", 0, 0}, LineCase{"1e3", 1000, 0},
                    LineCase{"10fc", 10 / (0.3048 * 0.3048), 0}, LineCase{"192,5600", 192, 5600},
                    LineCase{"192lx; 5600K", 192, 5600}, LineCase{"192\t3200", 192, 3200},
                    LineCase{"192 lx 3200 K", 192, 3200}));

TEST(TextFrame, BlankLinesAndCommentsAreNothing) {
  for (const char* line : {"", "  ", "\r", "# lux", "// lux", "; lux"}) {
    const auto reading = DecodeLine(line);
    ASSERT_TRUE(reading) << line;
    EXPECT_FALSE(*reading) << line;
  }
}

class BadLine : public testing::TestWithParam<const char*> {};
TEST_P(BadLine, IsRefusedWithAnExample) {
  const auto reading = DecodeLine(GetParam());
  ASSERT_FALSE(reading) << GetParam();
  EXPECT_EQ(reading.error().code, "bad_reply");
  EXPECT_THAT(reading.error().message, HasSubstr("17.8fc"));
}
INSTANTIATE_TEST_SUITE_P(TextFrame, BadLine,
                         testing::Values("lux", "nan", "inf", "-3", "2e6", "192x", "17,8fc",
                                         "192,5", "1,234.5", "192,5600,7", "192,900K", "1 2 3",
                                         "\x02\xff", "192,", "ERROR 192"));

// Gives these lines, one a read, then nothing more.
class Lines final : public Transport {
 public:
  explicit Lines(std::deque<std::string> lines) : lines_(std::move(lines)) {}
  Result<void> Write(std::span<const std::byte>, std::chrono::milliseconds) override { return {}; }
  Result<Bytes> Read(std::size_t, std::chrono::milliseconds) override {
    if (lines_.empty()) return Failed(std::string(fault::kTimeout), "lines", "silent");
    const std::string line = lines_.front();
    lines_.pop_front();
    const auto bytes = AsBytes(line);
    return Bytes(bytes.begin(), bytes.end());
  }
  [[nodiscard]] std::string Name() const override { return "lines"; }

 private:
  std::deque<std::string> lines_;
};

Result<MeterReading> Measured(std::deque<std::string> given,
                              const std::map<std::string, std::string>& options = {}) {
  Lines lines(std::move(given));
  auto setup = QuickSetup();
  setup.options = options;
  const auto meter = MakeLine(lines, setup);
  if (auto identity = meter->Identify(); !identity) return Propagate(std::move(identity));
  return meter->Measure(Cancellation());
}

TEST(LineMeter, AnUndeclaredSourceIsABareSensorWithALargeSigma) {
  const auto reading = Measured({"192,5600"});
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 192.0);
  EXPECT_EQ(reading->reading.cct->value(), 5600.0);
  EXPECT_EQ(reading->reading.quality, MeterQuality::kBareSensor);
  EXPECT_EQ(*reading->reading.sigma_relative, kUndeclaredSigma);
  EXPECT_TRUE(reading->warnings.empty());
}

TEST(LineMeter, WhatAPersonDeclaresHolds) {
  const auto reading = Measured({"192"}, {{"sigma", "5%"}, {"quality", "photometer"}});
  EXPECT_EQ(*reading->reading.sigma_relative, 0.05);
  EXPECT_EQ(reading->reading.quality, MeterQuality::kPhotometer);
  EXPECT_EQ(*Measured({"192"}, {{"sigma", "0.02"}})->reading.sigma_relative, 0.02);
  for (const char* sigma : {"0", "1", "200%", "-0.1", "five"}) {
    EXPECT_EQ(Measured({"192"}, {{"sigma", sigma}}).error().kind, ErrorKind::kUsage) << sigma;
  }
  EXPECT_EQ(Measured({"192"}, {{"quality", "good"}}).error().kind, ErrorKind::kUsage);
}

TEST(LineMeter, LinesThatAreNoReadingsAreCountedAndTooManyRefused) {
  const auto reading = Measured({"booting", "# lux", "", "ready", "192"});
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->warnings.at(0).code, "bad_lines");
  EXPECT_THAT(reading->warnings.at(0).message, HasSubstr("2 lines"));
  std::deque<std::string> garbage(kMostBadLines, "x");
  garbage.emplace_back("192");
  EXPECT_TRUE(Measured(garbage));
  garbage.emplace_front("x");
  EXPECT_EQ(Measured(garbage).error().code, "bad_reply");
  EXPECT_EQ(Measured(std::deque<std::string>(1000, "# comment")).error().code, "bad_reply");
  EXPECT_EQ(Measured({"booting"}).error().code, "timeout");
}

TEST(LineMeter, CtrlCStopsIt) {
  Lines lines({"192"});
  Cancellation cancellation;
  cancellation.Request();
  EXPECT_EQ(MakeLine(lines, QuickSetup())->Measure(cancellation).error().code, "interrupted");
}

TEST(TypedMeter, IsByHandAndLeavesTheSigmaToTheSession) {
  const auto line = OpenTyped([] { return std::optional<std::string>("17.8fc"); });
  const auto reading = MakeTyped(*line, QuickSetup())->Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 191.5976, 1e-4);
  EXPECT_EQ(reading->reading.device, "");
  EXPECT_FALSE(reading->reading.sigma_relative);
  EXPECT_EQ(reading->reading.quality, MeterQuality::kUnknown);
}

TEST(TypedMeter, AWrongWordAndNoWordAreSaid) {
  const auto wrong = OpenTyped([] { return std::optional<std::string>("abc"); });
  EXPECT_EQ(MakeTyped(*wrong, QuickSetup())->Measure(Cancellation()).error().code, "bad_reply");
  const auto none = OpenTyped([] { return std::optional<std::string>(); });
  EXPECT_EQ(MakeTyped(*none, QuickSetup())->Measure(Cancellation()).error().code, "ended");
}

TEST(LineMeter, ARecordedSourceReplaysToTheSameReading) {
  Lines lines({"booting", "192,5600"});
  Tape tape;
  RecordingTransport recording(lines, tape);
  const auto first = MakeLine(recording, QuickSetup())->Measure(Cancellation());
  ReplayTransport replay(tape);
  const auto again = MakeLine(replay, QuickSetup())->Measure(Cancellation());
  EXPECT_EQ(replay.Unconsumed(), 0U);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->reading.illuminance->value(), again->reading.illuminance->value());
  EXPECT_EQ(again->warnings.size(), 1U);
}

}  // namespace
}  // namespace lightcal::devices::text
