// SPDX-License-Identifier: Apache-2.0
// The dialogue with sensor chips behind the bridge, in memory: every chip, every fault.
#include <gmock/gmock.h>

#include "fake_mcp2221.h"
#include "fake_transport.h"
#include "hex_bytes.h"
#include "lightcal_devices/meters/i2c_sensors/veml7700.h"
#include "lightcal_devices/meters/mcp2221/meter.h"

namespace lightcal::devices::mcp2221 {
namespace {

using test::FakeMcp2221Line;
using test::FromHex;
using test::Mcp2221Setting;
using Fault = Mcp2221Setting::Fault;
using testing::HasSubstr;

MeterSetup With(std::map<std::string, std::string> options = {}) {
  MeterSetup setup = test::QuickSetup();
  setup.options = std::move(options);
  return setup;
}

Mcp2221Setting Holding(std::uint8_t address, test::FakeChip chip) {
  Mcp2221Setting setting;
  setting.chips[address] = std::move(chip);
  return setting;
}

TEST(Mcp2221Meter, ReadsABh1750AndLeavesItOff) {
  const auto orders = std::make_shared<Bytes>();
  FakeMcp2221Line line(Holding(0x23, test::Bh1750(41, orders)));
  Mcp2221Meter meter(line, With({{"sensor", "bh1750"}}));
  const auto reading = meter.Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 34.1667, 5e-5);
  EXPECT_EQ(reading->reading.device, "mcp2221:BH1750");
  EXPECT_EQ(reading->reading.quality, MeterQuality::kBareSensor);
  EXPECT_GE(*reading->reading.sigma_relative, kSigmaRelative);
  EXPECT_FALSE(reading->reading.cct);
  // Power on, measuring time 69, one-time mode, after which the chip switches itself off.
  EXPECT_EQ(*orders, FromHex("01 42 65 20"));
  EXPECT_EQ(line.bridge().engine(), 0U);
}

TEST(Mcp2221Meter, FindsAnOpt3001ByItsIdAndPutsItsConfigurationBack) {
  const auto chip = test::Opt3001(0x3456);
  FakeMcp2221Line line(Holding(0x45, test::ChipOf(chip)));
  const auto reading = Mcp2221Meter(line, With()).Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 88.80, 1e-9);
  EXPECT_EQ(chip->written.front(), FromHex("01 CA 10"));
  EXPECT_EQ(chip->written.back(), FromHex("01 C8 10"));
}

TEST(Mcp2221Meter, TellsAnOpt4048FromAnOpt3001AtTheSameAddress) {
  // Codes 80000, 100000, 40000, 0 with exponent 0 and counter 0.
  const auto chip = test::Opt4048(FromHex("01 38 80 0B 01 86 A0 00 00 9C 40 09 00 00 00 00"));
  FakeMcp2221Line line(Holding(0x44, test::ChipOf(chip)));
  Mcp2221Meter meter(line, With());
  EXPECT_EQ(meter.Identify()->model, "OPT4048");
  const auto reading = meter.Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 215.0, 1e-9);
  EXPECT_TRUE(reading->reading.xy);
  EXPECT_EQ(reading->reading.color_source, ColorSource::kColorimeter);
  EXPECT_EQ(chip->written.back(), FromHex("0A 32 08"));
}

class Veml7700Range : public testing::TestWithParam<double> {};
TEST_P(Veml7700Range, FindsASettingThatResolvesTheLight) {
  const auto chip = test::Veml7700(GetParam());
  FakeMcp2221Line line(Holding(0x10, test::ChipOf(chip)));
  const auto reading = Mcp2221Meter(line, With({{"sensor", "veml7700"}})).Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  const double shown = reading->reading.illuminance->value();
  // Bent at most a few per cent below 1000 lx; above, the chip's own correction says how much.
  EXPECT_GT(shown, 0.99 * GetParam());
  EXPECT_LT(shown, GetParam() < 1000.0 ? 1.1 * GetParam() : 4.0 * GetParam());
  EXPECT_FALSE(reading->reading.over_range);
  EXPECT_EQ(chip->written.back(), FromHex("00 01 00")) << "shut down, as it was";
}
INSTANTIATE_TEST_SUITE_P(Mcp2221Meter, Veml7700Range,
                         testing::Values(0.5, 20.0, 300.0, 5000.0, 15000.0));

TEST(Mcp2221Meter, DarknessIsALimit) {
  FakeMcp2221Line line(Holding(0x23, test::Bh1750(0, nullptr)));
  const auto reading = Mcp2221Meter(line, With({{"sensor", "bh1750"}})).Measure(Cancellation());
  EXPECT_TRUE(reading->reading.under_range);
  EXPECT_NEAR(reading->reading.illuminance->value(), 1.0 / 1.2, 1e-12);
}

TEST(Mcp2221Meter, AnEngineInTheMiddleOfSomethingIsFreed) {
  auto setting = Holding(0x23, test::Bh1750(41, nullptr));
  setting.busy_at_first = true;
  FakeMcp2221Line line(setting);
  EXPECT_TRUE(Mcp2221Meter(line, With({{"sensor", "bh1750"}})).Measure(Cancellation()));
}

TEST(Mcp2221Meter, AnAnonymousChipIsNamedByThePersonNotGuessed) {
  FakeMcp2221Line line(Holding(0x23, test::Bh1750(41, nullptr)));
  const auto identity = Mcp2221Meter(line, With()).Identify();
  EXPECT_EQ(identity.error().code, "no_sensor");
  EXPECT_THAT(identity.error().message, HasSubstr("at 0x23"));
  EXPECT_THAT(identity.error().message, HasSubstr("{meter.option} sensor=bh1750"));
}

TEST(Mcp2221Meter, ANackOfTheNamedAddressIsSaid) {
  FakeMcp2221Line line(Mcp2221Setting{});
  const auto found = Mcp2221Meter(line, With({{"sensor", "bh1750"}})).Identify();
  EXPECT_EQ(found.error().code, "no_sensor");
  FakeMcp2221Line named(Mcp2221Setting{});
  const auto reading = Mcp2221Meter(named, With({{"sensor", "bh1750"}, {"address", "0x5c"}}))
                           .Measure(Cancellation());
  EXPECT_EQ(reading.error().code, i2c::kNack);
  EXPECT_EQ(reading.error().subject, "I2C 0x5c");
  EXPECT_EQ(named.bridge().engine(), 0U) << "freed after the failure";
}

TEST(Mcp2221Meter, WrongOptionsAreAWrongCommandLine) {
  FakeMcp2221Line line(Mcp2221Setting{});
  for (const std::map<std::string, std::string>& options :
       {std::map<std::string, std::string>{{"sensor", "tsl2561"}},
        {{"address", "0x23"}},
        {{"sensor", "bh1750"}, {"address", "0x99"}}}) {
    const auto identity = Mcp2221Meter(line, With(options)).Identify();
    EXPECT_EQ(identity.error().kind, ErrorKind::kUsage);
  }
}

struct FaultCase {
  Fault fault;
  std::uint8_t command;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.code; }
class BridgeFault : public testing::TestWithParam<FaultCase> {};
TEST_P(BridgeFault, IsATypedErrorThatSaysWhatToDo) {
  auto setting = Holding(0x23, test::Bh1750(41, nullptr));
  setting.fault = GetParam().fault;
  setting.fault_command = GetParam().command;
  FakeMcp2221Line line(setting);
  const auto reading = Mcp2221Meter(line, With({{"sensor", "bh1750"}})).Measure(Cancellation());
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, GetParam().code) << reading.error().message;
  EXPECT_FALSE(reading.error().message.empty());
}
INSTANTIATE_TEST_SUITE_P(Mcp2221Meter, BridgeFault,
                         testing::Values(FaultCase{Fault::kSilent, 0x10, "timeout"},
                                         FaultCase{Fault::kSilent, 0x40, "timeout"},
                                         FaultCase{Fault::kShort, 0x90, "bad_reply"},
                                         FaultCase{Fault::kBusHeld, 0x90, "bus_fault"},
                                         FaultCase{Fault::kAlwaysBusy, 0x91, "busy"},
                                         FaultCase{Fault::kUnplug, 0x90, "unplugged"}));

TEST(Mcp2221Meter, ACancelledMeasurementPutsTheConfigurationBack) {
  const auto chip = test::Opt3001(0x3456);
  FakeMcp2221Line line(Holding(0x44, test::ChipOf(chip)));
  Mcp2221Meter meter(line, With());
  ASSERT_TRUE(meter.Identify());
  Cancellation cancellation;
  cancellation.Request();
  EXPECT_EQ(meter.Measure(cancellation).error().code, "interrupted");
  EXPECT_EQ(chip->written.back(), FromHex("01 C8 10"));
}

}  // namespace
}  // namespace lightcal::devices::mcp2221
