// SPDX-License-Identifier: Apache-2.0
// The dialogue, on a line in memory: no waiting, every fault.
#include "lightcal_devices/meters/display_meter.h"
#include "stream_meters.h"

namespace lightcal::devices::gm1020 {
namespace {

using test::Hex;
using test::Spoken;
using test::StreamFake;
using testing::EndsWith;
using testing::HasSubstr;

constexpr test::Make kMake = MakeDisplayMeter<kProtocol>;

const std::string kStart = Hex("3C 01 00 00 00 00 00 3D");
const std::string kStop = Hex("3C 02 00 00 00 00 00 3E");
const std::string kSays123lx = Hex("33 22 04 D2 01 00 FD 11");

// Says the frames one a moment between start and stop, then the last one again and again.
test::Speak Live(std::vector<std::string> frames) {
  return [frames = std::move(frames), live = false,
          next = std::size_t{0}](std::string& unread) mutable {
    if (unread.find(kStart) != std::string::npos) live = true;
    if (unread.find(kStop) != std::string::npos) live = false;
    unread.clear();
    if (!live || frames.empty()) return Spoken{};
    const std::string frame = frames[next];
    if (next + 1 < frames.size()) ++next;
    return Spoken{frame, false};
  };
}

TEST(Gm1020Meter, StartsReadsAndStops) {
  StreamFake line(Live({kSays123lx}));
  const auto reading = test::MeasuredOn(line, kMake);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  EXPECT_EQ(reading->reading.device, "gm1020:GM1020");
  EXPECT_EQ(line.received(), kStart + kStop);
}

TEST(Gm1020Meter, CommandsGoOutByteByByte) {
  StreamFake line(Live({kSays123lx}));
  EXPECT_TRUE(test::MeasuredOn(line, kMake));
  for (const std::string& write : line.writes()) EXPECT_EQ(write.size(), 1U);
}

TEST(Gm1020Meter, NoiseAnEchoAndHalfAFrameBeforeTheFrameDoNoHarm) {
  for (const std::string& before :
       {std::string("\xFF\x33"), kStart, kSays123lx.substr(3), std::string("\x33\x22\x33")}) {
    const auto reading = test::Measured(Live({before + kSays123lx}), kMake);
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  }
}

TEST(Gm1020Meter, FramesOfAnEarlierRunAreForgotten) {
  StreamFake line(Live({kSays123lx}), Hex("33 22 00 00 01 00 FD 11") + Hex("33 22 00"));
  EXPECT_EQ(test::MeasuredOn(line, kMake)->reading.illuminance->value(), 123.4);
}

TEST(Gm1020Meter, AboveItsHighestRangeItIsCensored) {
  const auto reading = test::Measured(Live({Hex("33 22 CF FF 01 00 FD 11")}), kMake);
  EXPECT_TRUE(reading->reading.over_range);
  EXPECT_EQ(reading->reading.illuminance->value(), 200000.0);
}

// Whatever goes wrong, live mode is ended.
struct FaultCase {
  const char* name;
  std::vector<std::string> frames;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class Fault : public testing::TestWithParam<FaultCase> {};
TEST_P(Fault, IsNamedAndTheMeterIsStopped) {
  StreamFake line(Live(GetParam().frames));
  const auto reading = test::MeasuredOn(line, kMake);
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, GetParam().code) << reading.error().message;
  EXPECT_THAT(line.received(), EndsWith(kStop));
  EXPECT_LT(line.reads(), 40);
}
INSTANTIATE_TEST_SUITE_P(
    Gm1020Meter, Fault,
    testing::Values(FaultCase{"Silent", {}, "timeout"},
                    FaultCase{"Noise", {std::string(24, 'x')}, "bad_reply"},
                    FaultCase{"UnknownBits", {Hex("33 22 14 D2 01 00 FD 11")}, "bad_reply"},
                    FaultCase{"Torn", {kSays123lx.substr(0, 5), ""}, "bad_reply"}),
    [](const auto& fault_case) { return std::string(fault_case.param.name); });

TEST(Gm1020Meter, OneFrameWithUnknownBitsIsPassedOver) {
  EXPECT_TRUE(test::Measured(Live({Hex("33 22 14 D2 01 00 FD 11"), kSays123lx}), kMake));
}

TEST(Gm1020Meter, SilenceSaysWhatToDo) {
  EXPECT_THAT(test::Measured(Live({}), kMake).error().message,
              HasSubstr("switch the meter off, plug its cable in"));
}

TEST(Gm1020Meter, CtrlCStopsTheMeter) {
  StreamFake line(Live({}));
  Cancellation cancellation;
  test::CancelAtRead cancelling(line, cancellation, 2);
  const auto reading = kMake(cancelling, test::QuickSetup())->Measure(cancellation);
  EXPECT_EQ(reading.error().code, "interrupted");
  EXPECT_EQ(line.received(), kStart + kStop);
}

TEST(Gm1020Meter, AnUnpluggedMeterIsNotSpokenToAgain) {
  const auto speak = [](std::string&) { return Spoken{kSays123lx.substr(0, 5), true}; };
  StreamFake line(speak);
  EXPECT_EQ(test::MeasuredOn(line, kMake).error().code, "unplugged");
  EXPECT_EQ(line.received(), kStart);
}

TEST(Gm1020Meter, AReadingSurvivesAMeterThatCannotBeStopped) {
  const auto speak = [](std::string&) { return Spoken{kSays123lx, true}; };
  const auto reading = test::Measured(speak, kMake);
  ASSERT_TRUE(reading);
  EXPECT_THAT(test::CodesOf(*reading), testing::ElementsAre("not_restored"));
}

TEST(Gm1020Meter, WhatIsRecordedReplays) {
  test::ExpectReplaysToTheSame(Live({"\xFF" + kSays123lx}), kMake);
  test::ExpectReplaysToTheSame(Live({kSays123lx.substr(0, 5), ""}), kMake);
  test::ExpectReplaysToTheSame(Live({}), kMake);
}

}  // namespace
}  // namespace lightcal::devices::gm1020
