// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/i2c_sensors/bh1750.h"

#include <array>
#include <chrono>
#include <string>

namespace lightcal::devices::i2c::bh1750 {
namespace {

constexpr double kCountsPerLux = 1.2;
constexpr unsigned kHighestCount = 0xFFFF;
constexpr std::byte kPowerOn{0x01};
constexpr std::byte kOneTimeHighResolution{0x20};
constexpr std::byte kMeasurementTimeHigh{0x40 | (kDefaultMeasurementTime >> 5)};
constexpr std::byte kMeasurementTimeLow{0x60 | (kDefaultMeasurementTime & 0x1F)};
constexpr std::chrono::milliseconds kConversion(180);  // longest of the data sheet

}  // namespace

Result<SensorLight> Decode(std::span<const std::byte> bytes, int measurement_time) {
  if (bytes.size() != 2) {
    return Failed("bad_reply", "BH1750",
                  "answered " + std::to_string(bytes.size()) + " bytes, not 2; try again");
  }
  const unsigned raw =
      std::to_integer<unsigned>(bytes[0]) << 8U | std::to_integer<unsigned>(bytes[1]);
  SensorLight light;
  light.step_lx = static_cast<double>(kDefaultMeasurementTime) / measurement_time / kCountsPerLux;
  light.under_range = raw == 0;
  light.over_range = raw == kHighestCount;
  const double counts = light.under_range ? 1.0 : raw;
  light.illuminance_lx = counts * kDefaultMeasurementTime / measurement_time / kCountsPerLux;
  return light;
}

Result<SensorLight> Measure(I2cBus& bus, Address address, const SensorContext& context) {
  for (const std::byte order :
       {kPowerOn, kMeasurementTimeHigh, kMeasurementTimeLow, kOneTimeHighResolution}) {
    if (auto go_on = CheckNotCancelled(context, "BH1750"); !go_on) {
      return tl::unexpected(go_on.error());
    }
    const std::array bytes = {order};
    if (auto taken = bus.Write(address, bytes); !taken) return tl::unexpected(taken.error());
  }
  context.timing.Pause(kConversion);
  const auto bytes = bus.Read(address, 2);
  if (!bytes) return tl::unexpected(bytes.error());
  return Decode(*bytes);
}

}  // namespace lightcal::devices::i2c::bh1750
