// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/i2c_sensors/opt4048.h"

#include <bit>
#include <chrono>
#include <string>

#include "lightcal_devices/meters/i2c_sensors/restored_register.h"

namespace lightcal::devices::i2c::opt4048 {
namespace {

constexpr auto kOrder = ByteOrder::kHighFirst;
constexpr std::uint8_t kFirstResult = 0x00;
constexpr std::uint8_t kConfiguration = 0x0A;
constexpr std::uint8_t kStatus = 0x0C;
constexpr std::uint8_t kDeviceId = 0x11;
constexpr std::uint16_t kOpt4048 = 0x0821;
constexpr std::uint16_t kOneShot = 0x3218;  // automatic range, 100 ms, latched
constexpr std::uint16_t kReady = 0x0004;
constexpr std::uint16_t kOverload = 0x0008;
constexpr double kLuxPerCode = 2.15e-3;
constexpr Polls kPolls{.pause = std::chrono::milliseconds(50), .count = 40};
constexpr int kTries = 2;  // a damaged burst is read once more

constexpr std::array<std::array<double, 3>, 3> kXyzFromCodes = {{
    {2.34892992e-4, 4.07467441e-5, 9.28619404e-5},
    {-1.89652390e-5, 1.98958202e-4, -1.69739553e-5},
    {1.20811684e-5, -1.58848115e-5, 6.74021520e-4},
}};

unsigned Parity(std::uint32_t bits) { return static_cast<unsigned>(std::popcount(bits)) & 1U; }

Result<std::array<Channel, 4>> ReadChannels(I2cBus& bus, Address address) {
  const std::array command = {std::byte{kFirstResult}};
  Result<std::array<Channel, 4>> channels;
  for (int i = 0; i < kTries; ++i) {
    const auto bytes = bus.WriteThenRead(address, command, kChannelsBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    channels = DecodeChannels(*bytes);
    if (channels) return channels;
  }
  return channels;
}

}  // namespace

unsigned Checksum(const Channel& channel) {
  const unsigned e = channel.exponent;
  const std::uint32_t r = channel.result;
  const unsigned n = channel.counter;
  const unsigned all = Parity(e) ^ Parity(r) ^ Parity(n);
  const unsigned odd = Parity(r & 0xAAAAAU) ^ Parity(n & 0xAU) ^ Parity(e & 0xAU);
  const unsigned every_fourth = Parity(r & 0x88888U) ^ Parity(n & 0x8U) ^ Parity(e & 0x8U);
  const unsigned every_eighth = Parity(r & 0x80808U);
  return every_eighth << 3U | every_fourth << 2U | odd << 1U | all;
}

Result<std::array<Channel, 4>> DecodeChannels(std::span<const std::byte> bytes) {
  if (bytes.size() != kChannelsBytes) {
    return Failed("bad_reply", "OPT4048",
                  "answered " + std::to_string(bytes.size()) + " bytes, not 16; try again");
  }
  std::array<Channel, 4> channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto at = [&](std::size_t k) { return std::to_integer<std::uint32_t>(bytes[4 * i + k]); };
    channels[i] = {at(0) >> 4U, (at(0) & 0xFU) << 16U | at(1) << 8U | at(2), at(3) >> 4U};
    if (Checksum(channels[i]) != (at(3) & 0xFU)) {
      return Failed("bad_reply", "OPT4048",
                    "the checksum of channel " + std::to_string(i) +
                        " is wrong; shorten the wires to the sensor and try again");
    }
  }
  return channels;
}

SensorLight LightFromChannels(const std::array<Channel, 4>& channels, std::uint16_t status) {
  SensorLight light;
  light.step_lx = kLuxPerCode * (1U << channels[1].exponent);
  light.illuminance_lx = kLuxPerCode * channels[1].Code();
  light.over_range = (status & kOverload) != 0 || light.illuminance_lx > kHighestLx;
  light.under_range = !light.over_range && channels[1].result == 0;
  if (light.over_range) light.illuminance_lx = kHighestLx;
  if (light.under_range) light.illuminance_lx = light.step_lx;
  if (light.over_range || light.under_range) return light;
  std::array<double, 3> xyz{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) xyz[row] += kXyzFromCodes[row][k] * channels[k].Code();
  }
  const bool is_color = xyz[0] > 0.0 && xyz[1] > 0.0 && xyz[2] > 0.0;
  if (is_color) light.xy = XyFromXyz(Xyz{xyz[0], xyz[1], xyz[2]});
  return light;
}

Result<bool> IsHere(I2cBus& bus, Address address) {
  return SaysId(ReadRegister(bus, address, kDeviceId, kOrder), kOpt4048);
}

Result<SensorLight> Measure(I2cBus& bus, Address address, const SensorContext& context) {
  const auto ask = [&]() -> Result<std::optional<SensorLight>> {
    const auto status = ReadRegister(bus, address, kStatus, kOrder);
    if (!status) return tl::unexpected(status.error());
    if ((*status & (kReady | kOverload)) == 0) return std::nullopt;
    const auto channels = ReadChannels(bus, address);
    if (!channels) return tl::unexpected(channels.error());
    return LightFromChannels(*channels, *status);
  };
  return WithRegister({bus, address, kConfiguration, kOrder}, kOneShot,
                      [&] { return PollForLight(context, "OPT4048", kPolls, ask); });
}

}  // namespace lightcal::devices::i2c::opt4048
