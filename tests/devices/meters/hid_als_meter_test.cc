// SPDX-License-Identifier: Apache-2.0
// The dialogue with a HID light sensor, in memory.
#include <gmock/gmock.h>

#include "fake_hid_als.h"
#include "fake_transport.h"
#include "hid_descriptors.h"
#include "lightcal_devices/meters/hid_als/meter.h"

namespace lightcal::devices::hid_als {
namespace {

using test::FakeHidAls;
using test::FromHex;
using test::QuickSetup;

// Asleep: reports no events, power undefined; interval 0.
const char* const kAsleep = "01 00 00 00 01 00 00 00 00";
const char* const kAwake = "01 00 01 01 01 00 00 00 00";

void Prepare(FakeHidAls& sensor) {
  sensor.descriptor = test::ColorHugDescriptor();
  sensor.feature = FromHex(kAsleep);
  sensor.inputs = {FromHex("01 01 03 39 30 00 00")};
}

TEST(HidAlsMeter, WakesTheSensorReadsItAndPutsItBack) {
  FakeHidAls sensor;
  Prepare(sensor);
  const auto reading = HidAlsMeter(sensor, QuickSetup("S1")).Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 123.45);
  EXPECT_EQ(reading->reading.quality, MeterQuality::kBareSensor);
  EXPECT_NEAR(*reading->reading.sigma_relative, kSigmaRelative, 1e-6);
  EXPECT_EQ(reading->reading.device, "hid_als:S1");
  EXPECT_TRUE(reading->warnings.empty());
  ASSERT_EQ(sensor.features_set.size(), 4U);
  EXPECT_EQ(sensor.features_set[1], FromHex(kAwake));
  EXPECT_EQ(sensor.feature, FromHex(kAsleep));
}

TEST(HidAlsMeter, ASensorThatIsAwakeIsLeftAlone) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.feature = FromHex(kAwake);
  EXPECT_TRUE(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()));
  EXPECT_TRUE(sensor.features_set.empty());
}

TEST(HidAlsMeter, ASilentSensorIsAsked) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.inputs.clear();
  sensor.polled = FromHex("01 01 03 0A 00 00 00");
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation())->reading.illuminance->value(),
            0.1);
}

TEST(HidAlsMeter, ASilentSensorThatCannotBeAskedTimesOutAndIsPutBack) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.inputs.clear();
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()).error().code, "timeout");
  EXPECT_EQ(sensor.feature, FromHex(kAsleep));
}

TEST(HidAlsMeter, OneShortReportIsForgivenTwoAreNot) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.inputs.push_front(FromHex("01 01 03"));
  EXPECT_TRUE(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()));
  Prepare(sensor);
  sensor.inputs.push_front(FromHex("01 01 03"));
  sensor.inputs.push_front(FromHex("01 01 03"));
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()).error().code, "bad_reply");
}

TEST(HidAlsMeter, ReportsOfOtherSensorsArePassedOver) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.inputs.push_front(FromHex("09 11 22 33"));
  EXPECT_TRUE(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()));
}

TEST(HidAlsMeter, ASensorThatNeverGetsReadyIsSaid) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.inputs.assign(100, FromHex("01 03 03 39 30 00 00"));
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()).error().code, "not_ready");
}

TEST(HidAlsMeter, AnUnpluggedSensorIsNotSpokenToAgain) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.unplugged_at_read = true;
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Measure(Cancellation()).error().code, "unplugged");
  EXPECT_EQ(sensor.features_set.size(), 2U);
}

TEST(HidAlsMeter, ACancelledMeasurementPutsTheSensorBack) {
  FakeHidAls sensor;
  Prepare(sensor);
  Cancellation cancellation;
  cancellation.Request();
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Measure(cancellation).error().code, "interrupted");
  EXPECT_EQ(sensor.feature, FromHex(kAsleep));
}

TEST(HidAlsMeter, TheEndsOfTheScaleAreLimits) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.inputs = {FromHex("01 01 03 FF FF 00 00"), FromHex("01 01 03 00 00 00 00")};
  HidAlsMeter meter(sensor, QuickSetup());
  const auto bright = meter.Measure(Cancellation());
  EXPECT_TRUE(bright->reading.over_range);
  EXPECT_EQ(bright->reading.illuminance->value(), 655.35);
  const auto dark = meter.Measure(Cancellation());
  EXPECT_TRUE(dark->reading.under_range);
  EXPECT_EQ(dark->reading.illuminance->value(), 0.01);
}

TEST(HidAlsMeter, ADamagedDescriptorIsSaidBeforeAnythingIsSent) {
  FakeHidAls sensor;
  Prepare(sensor);
  sensor.descriptor.resize(20);
  EXPECT_EQ(HidAlsMeter(sensor, QuickSetup()).Identify().error().code, kBadDescriptor);
  EXPECT_TRUE(sensor.features_set.empty());
}

}  // namespace
}  // namespace lightcal::devices::hid_als
