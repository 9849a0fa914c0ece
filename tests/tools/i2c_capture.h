// SPDX-License-Identifier: Apache-2.0
// A captured I2C bus: logic samples -> transfers -> the bus that a sensor's code speaks to.
// Shares nothing with the product.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lightcal_devices/meters/i2c_sensors/i2c_bus.h"

namespace lightcal::test {

struct I2cTransfer {
  std::uint8_t address = 0;
  bool is_read = false;
  bool acknowledged = true;  // the address
  devices::Bytes bytes;
};

// Both wires, one byte a sample (bit 0 SCL, bit 1 SDA), of a sigrok session: the zip's logic-1-*
// members in order. Throws std::runtime_error when it is none.
[[nodiscard]] std::vector<std::uint8_t> SamplesOfSigrok(const std::string& path);
[[nodiscard]] std::vector<I2cTransfer> DecodeI2c(const std::vector<std::uint8_t>& samples);

// Plays captured transfers: each write must be the next captured one (an order the recorder gave
// twice counts once), each read gets the captured bytes. Anything else is not acknowledged.
class CapturedBus final : public devices::i2c::I2cBus {
 public:
  explicit CapturedBus(std::vector<I2cTransfer> transfers) : transfers_(std::move(transfers)) {}
  Result<void> Write(devices::i2c::Address address, std::span<const std::byte> bytes) override;
  Result<devices::Bytes> Read(devices::i2c::Address address, std::size_t count) override;
  Result<devices::Bytes> WriteThenRead(devices::i2c::Address address,
                                       std::span<const std::byte> bytes,
                                       std::size_t count) override;
  [[nodiscard]] bool Finished() const { return next_ == transfers_.size(); }

 private:
  std::vector<I2cTransfer> transfers_;
  std::size_t next_ = 0;
};

}  // namespace lightcal::test
