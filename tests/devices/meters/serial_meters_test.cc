// SPDX-License-Identifier: Apache-2.0
// Meters on serial ports through the real termios: each behind a pseudo-terminal, opened as
// --device driver:port opens it.
#include <gmock/gmock.h>

#include <bit>

#include "fake_gossen.h"
#include "fake_konica.h"
#include "fake_transport.h"
#include "lightcal_devices/meters/find_meters.h"

namespace lightcal::devices {
namespace {

using test::GossenAnswers;
using test::GossenWith;
using test::kCl200aBodies;
using test::kGossenLines;
using test::KonicaAnswers;
using test::kPullThePlug;
using test::kT10aBodies;
using test::SerialStandIn;
using testing::ElementsAre;

Result<MeterReading> MeasureOn(const std::string& driver, const SerialStandIn& port) {
  auto chosen = ChooseMeter({}, driver + ":" + port.path());
  if (!chosen) return Propagate(std::move(chosen));
  auto line = OpenMeter(*chosen, std::chrono::milliseconds(1));
  if (!line) return Propagate(std::move(line));
  return chosen->row->make(**line, test::QuickSetup())->Measure(Cancellation());
}

TEST(SerialMeters, AGossenMeasures) {
  const SerialStandIn port("\n", GossenAnswers(kGossenLines));
  const auto reading = MeasureOn("gossen", port);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
  EXPECT_THAT(port.commands(), ElementsAre("ECH ON", "*IDN?", "RAN:AUTO ON", "?"));
}

TEST(SerialMeters, ACl200aMeasuresAndRunsAgain) {
  const SerialStandIn port("\r\n", KonicaAnswers(kCl200aBodies));
  const auto reading = MeasureOn("konica_cl200a", port);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 27.3);
  EXPECT_EQ(reading->reading.xy->x, 0.4545);
  EXPECT_EQ(test::KonicaCommands(port.commands()).back(), "99550  0");
}

TEST(SerialMeters, AT10aMeasures) {
  const SerialStandIn port("\r\n", KonicaAnswers(kT10aBodies));
  EXPECT_EQ(MeasureOn("konica_t10a", port)->reading.illuminance->value(), 1234.0);
}

// A meter set to 7E1 sends its parity as the eighth bit where nobody takes it off.
TEST(SerialMeters, TheParityBitDoesNotMatter) {
  const SerialStandIn port("\r\n", [](const std::string& command) {
    std::string answer = KonicaAnswers(kCl200aBodies)(command);
    for (char& c : answer) {
      const auto bits = static_cast<unsigned char>(c);
      if (std::popcount(bits) % 2 == 1) c = static_cast<char>(bits | 0x80U);
    }
    return answer;
  });
  const auto reading = MeasureOn("konica_cl200a", port);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 27.3);
}

struct FaultCase {
  const char* name;
  std::string line;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class GossenOnAPort : public testing::TestWithParam<FaultCase> {};
TEST_P(GossenOnAPort, FailsByName) {
  const SerialStandIn port("\n", GossenAnswers(GossenWith("?", GetParam().line)));
  const auto reading = MeasureOn("gossen", port);
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, GetParam().code) << reading.error().message;
}
INSTANTIATE_TEST_SUITE_P(SerialMeters, GossenOnAPort,
                         testing::Values(FaultCase{"Silence", "", "timeout"},
                                         FaultCase{"Garbage", "\xff\x01", "bad_reply"},
                                         FaultCase{"Fault", "ERROR = 17", "hardware_error"},
                                         FaultCase{"Unplugged", kPullThePlug, "unplugged"}),
                         [](const auto& fault_case) { return std::string(fault_case.param.name); });

TEST(SerialMeters, ADamagedKonicaReplyFailsAndTheMeterRunsAgain) {
  const SerialStandIn port("\r\n", [](const std::string& command) {
    std::string answer = KonicaAnswers(kCl200aBodies)(command);
    if (command.substr(1, 4) == "0002") answer[10] = '9';
    return answer;
  });
  EXPECT_EQ(MeasureOn("konica_cl200a", port).error().code, "bad_reply");
  EXPECT_EQ(test::KonicaCommands(port.commands()).back(), "99550  0");
}

TEST(SerialMeters, APortInUseIsBusyAndAMissingOneIsNoDevice) {
  const SerialStandIn port("\n", GossenAnswers(kGossenLines));
  const auto held = OpenTty(port.path(), k9600_8N1);
  ASSERT_TRUE(held);
  EXPECT_EQ(MeasureOn("gossen", port).error().code, "busy");
  const auto missing = OpenMeter(*ChooseMeter({}, "gossen:/dev/ttyUSB999"));
  EXPECT_EQ(missing.error().code, "no_device");
  EXPECT_EQ(missing.error().subject, "gossen:/dev/ttyUSB999");
}

TEST(SerialMeters, WhoMayNotOpenAPortIsToldOfTheGroup) {
  auto meter = *ChooseMeter({}, "gossen:/dev/ttyUSB0");
  meter.access = MeterAccess::kNoPermission;
  EXPECT_THAT(Remedy(meter), testing::HasSubstr("join the group dialout"));
  EXPECT_THAT(Remedy(meter), testing::Not(testing::HasSubstr("SUBSYSTEM")));
}

}  // namespace
}  // namespace lightcal::devices
