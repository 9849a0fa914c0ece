// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/i2c_sensors/opt3001.h"

#include <chrono>
#include <cmath>
#include <string>

#include "lightcal_devices/meters/i2c_sensors/restored_register.h"

namespace lightcal::devices::i2c::opt3001 {
namespace {

constexpr auto kOrder = ByteOrder::kHighFirst;
constexpr std::uint8_t kResult = 0x00;
constexpr std::uint8_t kConfiguration = 0x01;
constexpr std::uint8_t kMakerId = 0x7E;
constexpr std::uint8_t kDeviceId = 0x7F;
constexpr std::uint16_t kTexasInstruments = 0x5449;
constexpr std::uint16_t kOpt3001 = 0x3001;
constexpr std::uint16_t kSingleShot = 0xCA10;  // automatic range, 800 ms
constexpr std::uint16_t kReady = 0x0080;
constexpr std::uint16_t kOverflow = 0x0100;
constexpr unsigned kHighestExponent = 11;
constexpr Polls kPolls{.pause = std::chrono::milliseconds(100), .count = 20};

}  // namespace

Result<SensorLight> Decode(std::uint16_t result, std::uint16_t configuration) {
  const unsigned exponent = result >> 12U;
  const unsigned mantissa = result & 0x0FFFU;
  if (exponent > kHighestExponent) {
    return Failed("bad_reply", "OPT3001",
                  "a result with the exponent " + std::to_string(exponent) + "; try again");
  }
  SensorLight light;
  // A quotient of whole numbers: 1234 * 0.1 lx reads 123.4, not 123.40000000000001.
  light.step_lx = static_cast<double>(1U << exponent) / 100.0;
  light.over_range = (configuration & kOverflow) != 0;
  light.under_range = !light.over_range && mantissa == 0;
  light.illuminance_lx = static_cast<double>(mantissa << exponent) / 100.0;
  if (light.over_range) light.illuminance_lx = kHighestLx;
  if (light.under_range) light.illuminance_lx = light.step_lx;
  return light;
}

Result<bool> IsHere(I2cBus& bus, Address address) {
  auto maker = SaysId(ReadRegister(bus, address, kMakerId, kOrder), kTexasInstruments);
  if (!maker || !*maker) return maker;
  return SaysId(ReadRegister(bus, address, kDeviceId, kOrder), kOpt3001);
}

Result<SensorLight> Measure(I2cBus& bus, Address address, const SensorContext& context) {
  const auto ask = [&]() -> Result<std::optional<SensorLight>> {
    const auto state = ReadRegister(bus, address, kConfiguration, kOrder);
    if (!state) return tl::unexpected(state.error());
    if ((*state & kReady) == 0) return std::nullopt;
    const auto result = ReadRegister(bus, address, kResult, kOrder);
    if (!result) return tl::unexpected(result.error());
    return Decode(*result, *state);
  };
  return WithRegister({bus, address, kConfiguration, kOrder}, kSingleShot,
                      [&] { return PollForLight(context, "OPT3001", kPolls, ask); });
}

}  // namespace lightcal::devices::i2c::opt3001
