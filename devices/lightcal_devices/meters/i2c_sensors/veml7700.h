// SPDX-License-Identifier: Apache-2.0
// Vishay VEML7700: illuminance, 16 bits, gain and integration time to choose; no id to trust.
// Source: Vishay VEML7700 data sheet, Rev. 1.7 (Nov 2023): 0.0042 lx a count at gain 2 and 800 ms.
// Older editions, and drivers after them, say 0.0036 and read 14 % low.
#pragma once

#include <array>

#include "lightcal_devices/meters/i2c_sensors/sensor.h"

namespace lightcal::devices::i2c::veml7700 {

// A gain and an integration time, with their bits of the configuration.
struct Setting {
  double gain = 1.0;
  int integration_ms = 100;
  std::uint16_t bits = 0;
  [[nodiscard]] double LuxPerCount() const {
    return 0.0042 * (800.0 / integration_ms) * 2.0 / gain;
  }
};
// From the least to the most sensitive.
inline constexpr std::array<Setting, 9> kSettings = {{{0.125, 25, 0x1300},
                                                      {0.125, 50, 0x1200},
                                                      {0.125, 100, 0x1000},
                                                      {0.25, 100, 0x1800},
                                                      {1.0, 100, 0x0000},
                                                      {2.0, 100, 0x0800},
                                                      {2.0, 200, 0x0840},
                                                      {2.0, 400, 0x0880},
                                                      {2.0, 800, 0x08C0}}};

// L = counts * LuxPerCount; at gain 1/8 and 1/4 the chip bends, and
//   E = 6.0135e-13 L^4 - 9.3924e-9 L^3 + 8.1488e-5 L^2 + 1.0023 L   [lx]
// 65535 counts are over range, 0 under; so is what the polynomial, which holds no further, makes
// more than kHighestLx of.
inline constexpr double kHighestLx = 120000.0;
[[nodiscard]] SensorLight Decode(std::uint16_t counts, const Setting& setting);

// Chooses the setting (too few counts: a more sensitive one, too many: a less), each step waiting
// two integration times; the configuration is put back.
[[nodiscard]] Result<SensorLight> Measure(I2cBus& bus, Address address,
                                          const SensorContext& context);

}  // namespace lightcal::devices::i2c::veml7700
