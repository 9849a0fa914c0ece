// SPDX-License-Identifier: Apache-2.0
// A configuration that is changed for a measurement and put back after it.
#pragma once

#include "lightcal_devices/meters/i2c_sensors/sensor.h"

namespace lightcal::devices::i2c {

struct RegisterOf {
  I2cBus& bus;
  Address address;
  std::uint8_t number;
  ByteOrder order;
};

// Reads the register, writes `value`, measures, and writes back what was read, also after a
// failure. A measurement whose register cannot be put back fails as the bus did.
template <class MeasureWithIt>
Result<SensorLight> WithRegister(const RegisterOf& which, std::uint16_t value,
                                 MeasureWithIt measure) {
  const auto former = ReadRegister(which.bus, which.address, which.number, which.order);
  if (!former) return tl::unexpected(former.error());
  const auto changed = WriteRegister(which.bus, which.address, which.number, value, which.order);
  if (!changed) return tl::unexpected(changed.error());
  auto light = measure();
  const bool is_gone = !light && light.error().code == fault::kUnplugged;
  if (is_gone) return light;
  const auto restored = WriteRegister(which.bus, which.address, which.number, *former, which.order);
  if (light && !restored) return tl::unexpected(restored.error());
  return light;
}

}  // namespace lightcal::devices::i2c
