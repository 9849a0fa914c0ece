// SPDX-License-Identifier: Apache-2.0
// A real BH1750 on a real bus, as a logic analyser saw it, read by the code that reads one live.
#include <gmock/gmock.h>

#include "hex_bytes.h"
#include "i2c_capture.h"
#include "lightcal_devices/meters/i2c_sensors/bh1750.h"
#include "run_cli.h"

namespace lightcal::devices::i2c {
namespace {

using test::CapturedBus;
using test::FromHex;

std::vector<test::I2cTransfer> Captured() {
  return test::DecodeI2c(
      test::SamplesOfSigrok(test::SampleData("i2c_captures/bh1750_hresolutionmode.sr")));
}

TEST(Bh1750Capture, HoldsOrdersAndOneReading) {
  const auto transfers = Captured();
  ASSERT_EQ(transfers.size(), 6U);
  const std::vector<std::string> bytes = {"01", "42", "65", "20", "20", "00 29"};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_EQ(transfers[i].address, 0x23);
    EXPECT_EQ(transfers[i].bytes, FromHex(bytes[i])) << i;
    EXPECT_EQ(transfers[i].is_read, i == 5);
  }
}

TEST(Bh1750Capture, DecodesTo34LuxThroughTheCodeOfLiveUse) {
  CapturedBus bus(Captured());
  MeterTiming timing;
  timing.live = false;
  const Cancellation cancellation;
  const auto light = bh1750::Measure(bus, 0x23, {timing, cancellation});
  ASSERT_TRUE(light) << light.error().message;
  EXPECT_NEAR(light->illuminance_lx, 34.17, 5e-3);
  EXPECT_TRUE(bus.Finished());
}

TEST(Bh1750Capture, ABusWithoutTheReadingIsNoReading) {
  auto transfers = Captured();
  transfers.pop_back();
  CapturedBus bus(transfers);
  MeterTiming timing;
  timing.live = false;
  const Cancellation cancellation;
  EXPECT_EQ(bh1750::Measure(bus, 0x23, {timing, cancellation}).error().code, kNack);
}

}  // namespace
}  // namespace lightcal::devices::i2c
