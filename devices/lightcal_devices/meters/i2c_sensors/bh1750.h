// SPDX-License-Identifier: Apache-2.0
// ROHM BH1750FVI: illuminance, 16 bits, no id register.
// Source: ROHM BH1750FVI Technical Note (11046EDT01).
#pragma once

#include "lightcal_devices/meters/i2c_sensors/sensor.h"

namespace lightcal::devices::i2c::bh1750 {

inline constexpr int kDefaultMeasurementTime = 69;  // of the register MTreg, 31 .. 254

// E = raw / 1.2 * 69 / MTreg   [lx], one-time or continuous high-resolution mode
// raw 0 is under range (less than one count), 65535 over.   Fails: bad_reply unless two bytes.
[[nodiscard]] Result<SensorLight> Decode(std::span<const std::byte> bytes,
                                         int measurement_time = kDefaultMeasurementTime);

// Power on, MTreg 69, one-time high-resolution mode; 180 ms later its two bytes. The chip then
// switches itself off, which is the state it is found in.
[[nodiscard]] Result<SensorLight> Measure(I2cBus& bus, Address address,
                                          const SensorContext& context);

}  // namespace lightcal::devices::i2c::bh1750
