// SPDX-License-Identifier: Apache-2.0
// The driver through the real libusb: ack, NAK, wrong ring, busy, timeout, short reply, stall,
// unplug, each on a device simulated by umockdev with a reply captured from a real meter.
#include <gmock/gmock.h>

#include "fake_transport.h"
#include "lightcal_devices/meters/find_meters.h"
#include "usb_stand_in.h"

namespace lightcal::devices {
namespace {

using test::Answering407lx;
using test::Fault;
using test::UsbStandIn;

Result<MeterReading> MeasureOverUsb() {
  auto found = FindMeters();
  if (!found) return Propagate(std::move(found));
  auto chosen = ChooseMeter(*found, "sekonic");
  if (!chosen) return Propagate(std::move(chosen));
  auto line = OpenMeter(*chosen, std::chrono::milliseconds(1));
  if (!line) return Propagate(std::move(line));
  const auto meter = chosen->row->make(**line, test::QuickSetup(chosen->serial));
  return meter->Measure(Cancellation());
}

TEST(SekonicOverUsb, ReadsTheCapturedReplyAndGivesTheMeterBack) {
  const UsbStandIn device(Answering407lx());
  const auto reading = MeasureOverUsb();
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 406.960, 5e-4);
  EXPECT_NEAR(reading->reading.cct->value(), 4995.02, 5e-3);
  EXPECT_THAT(device.commands(),
              testing::ElementsAre("MN", "ST", "RT1", "RM0", "ST", "ST", "ST", "NR", "RT0"));
  EXPECT_FALSE(device.remote());
}

TEST(SekonicOverUsb, ASecondReplyIsNotTheFirst) {
  auto setting = Answering407lx();
  setting.measurement = test::RecordedReply(test::kReply14lx);
  const UsbStandIn device(setting);
  EXPECT_NEAR(MeasureOverUsb()->reading.illuminance->value(), 14.0775, 5e-5);
}

test::UsbSetting OnInterruptEndpoints() {
  test::UsbSetting usb;
  usb.interrupt = true;
  return usb;
}

TEST(SekonicOverUsb, AnInterruptPairIsFoundWhereThereIsNoBulkPair) {
  const UsbStandIn device(Answering407lx(), OnInterruptEndpoints());
  const auto reading = MeasureOverUsb();
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 406.960, 5e-4);
  EXPECT_FALSE(device.remote());
}

TEST(SekonicOverUsb, SilenceOnAnInterruptPairIsATimeout) {
  auto setting = Answering407lx();
  setting.fault_command = "NR";
  setting.fault = Fault::kSilent;
  const UsbStandIn device(setting, OnInterruptEndpoints());
  EXPECT_EQ(MeasureOverUsb().error().code, "timeout");
  EXPECT_FALSE(device.remote());
}

struct FaultCase {
  const char* name;
  const char* command;
  Fault fault;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class UsbFault : public testing::TestWithParam<FaultCase> {};
TEST_P(UsbFault, IsATypedErrorAndTheMeterIsNotLeftInRemoteControl) {
  auto setting = Answering407lx();
  setting.fault_command = GetParam().command;
  setting.fault = GetParam().fault;
  const UsbStandIn device(setting);
  const auto reading = MeasureOverUsb();
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, GetParam().code) << reading.error().message;
  EXPECT_EQ(reading.error().kind, ErrorKind::kFailed);
  if (GetParam().fault != Fault::kUnplug) {
    EXPECT_FALSE(device.remote());
  }
}
INSTANTIATE_TEST_SUITE_P(
    SekonicOverUsb, UsbFault,
    testing::Values(FaultCase{"NakOnTakeOver", "RT1", Fault::kNak, "nak"},
                    FaultCase{"NakOnStart", "RM0", Fault::kNak, "nak"},
                    FaultCase{"SilentOnIdentify", "MN", Fault::kSilent, "timeout"},
                    FaultCase{"SilentOnFetch", "NR", Fault::kSilent, "timeout"},
                    FaultCase{"ShortMeasurement", "NR", Fault::kShort, "bad_reply"},
                    FaultCase{"WrongEcho", "NR", Fault::kWrongEcho, "bad_reply"},
                    FaultCase{"Stall", "NR", Fault::kStall, "stalled"},
                    FaultCase{"UnpluggedAtStart", "MN", Fault::kUnplug, "unplugged"},
                    FaultCase{"UnpluggedInTheMiddle", "RM0", Fault::kUnplug, "unplugged"}),
    [](const auto& fault_case) { return std::string(fault_case.param.name); });

TEST(SekonicOverUsb, AWrongRingIsSaid) {
  auto setting = Answering407lx();
  setting.ring = 3;
  const UsbStandIn device(setting);
  EXPECT_EQ(MeasureOverUsb().error().code, "wrong_ring");
}

TEST(SekonicOverUsb, AMeasurementWithoutEndIsBusy) {
  auto setting = Answering407lx();
  setting.busy_polls_after = 1000;
  const UsbStandIn device(setting);
  EXPECT_EQ(MeasureOverUsb().error().code, "busy");
  EXPECT_FALSE(device.remote());
}

TEST(SekonicOverUsb, AMeterHeldByAnotherProgramIsBusy) {
  const UsbStandIn device(Answering407lx(), {.serial = "", .held_by_another = true});
  const auto found = FindMeters();
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ(found->front().access, MeterAccess::kBusy);
  EXPECT_EQ(MeasureOverUsb().error().code, "busy");
}

TEST(SekonicOverUsb, TheSerialOfTheDeviceIsItsId) {
  const UsbStandIn device(Answering407lx(), {.serial = "J0123-45"});
  const auto found = FindMeters();
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ(found->front().id, "sekonic:J0123-45");
  EXPECT_EQ(MeasureOverUsb()->reading.device, "sekonic:J0123-45");
}

TEST(SekonicOverUsb, WithoutASerialThePlugIsItsId) {
  const UsbStandIn device(Answering407lx());
  EXPECT_EQ(FindMeters()->front().id, "sekonic:1-1");
}

TEST(SekonicOverUsb, AnEmptyMachineHasNoMeter) {
  const test::NoUsb machine;
  const auto found = FindMeters();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_TRUE(found->empty());
  EXPECT_EQ(MeasureOverUsb().error().code, "no_device");
}

}  // namespace
}  // namespace lightcal::devices
