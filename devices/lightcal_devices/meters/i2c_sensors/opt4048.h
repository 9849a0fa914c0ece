// SPDX-License-Identifier: Apache-2.0
// TI OPT4048: a tristimulus sensor; its four channels carry a counter and a checksum each.
// Source: TI data sheet SBOS979 (coefficients as Adafruit's driver prints them).
#pragma once

#include <array>

#include "lightcal_devices/meters/i2c_sensors/sensor.h"

namespace lightcal::devices::i2c::opt4048 {

inline constexpr std::size_t kChannelsBytes = 16;
inline constexpr double kHighestLx = 144000.0;  // end of the widest range

// One channel: exponent (4 bits), result R (20 bits), counter (4 bits), checksum (4 bits).
struct Channel {
  unsigned exponent = 0;
  std::uint32_t result = 0;
  unsigned counter = 0;
  [[nodiscard]] double Code() const { return static_cast<double>(result) * (1U << exponent); }
};
// The checksum a channel must carry; README.md spells its bits.
[[nodiscard]] unsigned Checksum(const Channel& channel);
// Fails: bad_reply unless 16 bytes with four sound checksums.
[[nodiscard]] Result<std::array<Channel, 4>> DecodeChannels(std::span<const std::byte> bytes);

// XYZ = M (code 0, code 1, code 2), E = 2.15e-3 code 1 [lx], xy of XYZ. xy is left out where a
// tristimulus value is not above 0. `status`: its bit 3 (overload) means over range.
[[nodiscard]] SensorLight LightFromChannels(const std::array<Channel, 4>& channels,
                                            std::uint16_t status);

[[nodiscard]] Result<bool> IsHere(I2cBus& bus, Address address);

// One shot of 100 ms a channel with automatic ranges; the configuration is put back.
[[nodiscard]] Result<SensorLight> Measure(I2cBus& bus, Address address,
                                          const SensorContext& context);

}  // namespace lightcal::devices::i2c::opt4048
