// SPDX-License-Identifier: Apache-2.0
// TI OPT3001: illuminance with its own exponent, 0.01 .. 83865.6 lx.
// Source: TI data sheet SBOS681, as devices' reference gives it.
#pragma once

#include "lightcal_devices/meters/i2c_sensors/sensor.h"

namespace lightcal::devices::i2c::opt3001 {

inline constexpr double kHighestLx = 83865.60;

// E = 0.01 * 2^exponent * mantissa   [lx]; result = exponent (4 bits), mantissa (12 bits)
// The overflow bit of the configuration means over range; a mantissa of 0 under.
// Fails: bad_reply with an exponent above 11, which the chip never gives.
[[nodiscard]] Result<SensorLight> Decode(std::uint16_t result, std::uint16_t configuration);

// The maker's and the device's id.
[[nodiscard]] Result<bool> IsHere(I2cBus& bus, Address address);

// A single shot of 800 ms over all ranges; the configuration is put back.
[[nodiscard]] Result<SensorLight> Measure(I2cBus& bus, Address address,
                                          const SensorContext& context);

}  // namespace lightcal::devices::i2c::opt3001
