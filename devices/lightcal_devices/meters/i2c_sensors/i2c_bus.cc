// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/i2c_sensors/i2c_bus.h"

#include <array>
#include <string>

namespace lightcal::devices::i2c {

Result<std::uint16_t> ReadRegister(I2cBus& bus, Address address, std::uint8_t number,
                                   ByteOrder order) {
  const std::array command = {static_cast<std::byte>(number)};
  const auto bytes = bus.WriteThenRead(address, command, 2);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->size() != 2) {
    return Failed("bad_reply", "I2C", "a register of " + std::to_string(bytes->size()) + " bytes");
  }
  const auto first = std::to_integer<unsigned>((*bytes)[0]);
  const auto second = std::to_integer<unsigned>((*bytes)[1]);
  return static_cast<std::uint16_t>(order == ByteOrder::kHighFirst ? first << 8U | second
                                                                   : second << 8U | first);
}

Result<void> WriteRegister(I2cBus& bus, Address address, std::uint8_t number, std::uint16_t value,
                           ByteOrder order) {
  const auto high = static_cast<std::byte>(value >> 8U);
  const auto low = static_cast<std::byte>(value & 0xFFU);
  const bool high_first = order == ByteOrder::kHighFirst;
  const std::array bytes = {static_cast<std::byte>(number), high_first ? high : low,
                            high_first ? low : high};
  return bus.Write(address, bytes);
}

}  // namespace lightcal::devices::i2c
