// SPDX-License-Identifier: Apache-2.0
// The I2C bus as a light sensor's code sees it: a bridge's, or a recorded one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::i2c {

// The code of an address, or a byte, that no chip acknowledged.
inline constexpr std::string_view kNack = "i2c_nack";

using Address = std::uint8_t;  // 7 bits: 0x08 .. 0x77

class I2cBus {
 public:
  I2cBus() = default;
  virtual ~I2cBus() = default;
  I2cBus(const I2cBus&) = delete;
  I2cBus& operator=(const I2cBus&) = delete;

  // Each fails as i2c_nack, or as the bridge does.
  virtual Result<void> Write(Address address, std::span<const std::byte> bytes) = 0;
  virtual Result<Bytes> Read(Address address, std::size_t count) = 0;
  // A write without stop, then a read: how a register is read.
  virtual Result<Bytes> WriteThenRead(Address address, std::span<const std::byte> bytes,
                                      std::size_t count) = 0;
};

// A register of 16 bits, and how its bytes are ordered.
enum class ByteOrder { kHighFirst, kLowFirst };
[[nodiscard]] Result<std::uint16_t> ReadRegister(I2cBus& bus, Address address, std::uint8_t number,
                                                 ByteOrder order);
[[nodiscard]] Result<void> WriteRegister(I2cBus& bus, Address address, std::uint8_t number,
                                         std::uint16_t value, ByteOrder order);

}  // namespace lightcal::devices::i2c
