// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/i2c_sensors/veml7700.h"

#include <chrono>

#include "lightcal_devices/meters/i2c_sensors/restored_register.h"

namespace lightcal::devices::i2c::veml7700 {
namespace {

constexpr auto kOrder = ByteOrder::kLowFirst;
constexpr std::uint8_t kConfiguration = 0x00;
constexpr std::uint8_t kAmbientLight = 0x04;
constexpr std::size_t kStart = 2;  // gain 1/8, 100 ms: where the data sheet begins
constexpr unsigned kFewCounts = 100;
constexpr unsigned kManyCounts = 10000;
constexpr unsigned kHighestCount = 0xFFFF;
constexpr double kHighestBentGain = 0.25;

double Straightened(double lux) {
  return (((6.0135e-13 * lux - 9.3924e-9) * lux + 8.1488e-5) * lux + 1.0023) * lux;
}

// Counts at one setting.
Result<std::uint16_t> Counts(I2cBus& bus, Address address, const Setting& setting,
                             const SensorContext& context) {
  if (auto go_on = CheckNotCancelled(context, "VEML7700"); !go_on) {
    return tl::unexpected(go_on.error());
  }
  if (auto set = WriteRegister(bus, address, kConfiguration, setting.bits, kOrder); !set) {
    return tl::unexpected(set.error());
  }
  context.timing.Pause(std::chrono::milliseconds(2 * setting.integration_ms));
  return ReadRegister(bus, address, kAmbientLight, kOrder);
}

// Moves away from the start in one direction only, so it ends.
Result<SensorLight> MeasureInRange(I2cBus& bus, Address address, const SensorContext& context) {
  std::size_t at = kStart;
  int direction = 0;
  while (true) {
    const Setting& setting = kSettings[at];
    const auto counts = Counts(bus, address, setting, context);
    if (!counts) return tl::unexpected(counts.error());
    const bool too_few = *counts <= kFewCounts && at + 1 < kSettings.size();
    const bool too_many = *counts > kManyCounts && at > 0;
    if (too_few && direction >= 0) {
      direction = 1;
      ++at;
    } else if (too_many && direction <= 0) {
      direction = -1;
      --at;
    } else {
      return Decode(*counts, setting);
    }
  }
}

}  // namespace

SensorLight Decode(std::uint16_t counts, const Setting& setting) {
  SensorLight light;
  light.step_lx = setting.LuxPerCount();
  light.under_range = counts == 0;
  light.over_range = counts == kHighestCount;
  const double lux = (light.under_range ? 1.0 : counts) * setting.LuxPerCount();
  light.illuminance_lx = setting.gain <= kHighestBentGain ? Straightened(lux) : lux;
  if (light.illuminance_lx > kHighestLx) {
    light.illuminance_lx = kHighestLx;
    light.over_range = true;
  }
  return light;
}

Result<SensorLight> Measure(I2cBus& bus, Address address, const SensorContext& context) {
  return WithRegister({bus, address, kConfiguration, kOrder}, kSettings[kStart].bits,
                      [&] { return MeasureInRange(bus, address, context); });
}

}  // namespace lightcal::devices::i2c::veml7700
