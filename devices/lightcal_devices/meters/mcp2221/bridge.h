// SPDX-License-Identifier: Apache-2.0
// The I2C bus behind a MCP2221A.
#pragma once

#include "lightcal_devices/meters/i2c_sensors/i2c_bus.h"
#include "lightcal_devices/meters/mcp2221/frame.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::mcp2221 {

// Each exchange is one report out and one in. How often the bridge is asked is counted, 1 ms apart.
class Bridge final : public i2c::I2cBus {
 public:
  Bridge(Transport& transport, const MeterTiming& timing)
      : transport_(transport), timing_(timing) {}

  // Frees a bus that is in the middle of something, and sets 100 kHz.
  // Fails: busy when it stays so, bad_reply, and as the line does.
  [[nodiscard]] Result<void> Prepare();

  // Each leaves the engine idle, also after a failure. Besides i2c_nack, bad_reply and the line's
  // faults they fail as bus_fault (wires, pull-ups) and busy.
  Result<void> Write(i2c::Address address, std::span<const std::byte> bytes) override;
  Result<Bytes> Read(i2c::Address address, std::size_t count) override;
  Result<Bytes> WriteThenRead(i2c::Address address, std::span<const std::byte> bytes,
                              std::size_t count) override;

 private:
  Result<Bytes> Exchange(const Bytes& request);
  Result<Status> AskStatus(const Bytes& request);
  // Hands a write or a read to the engine, again while it is busy.
  Result<void> Start(const Bytes& request, Command command, i2c::Address address);
  // Until the engine stands at `state` or is idle.
  Result<void> WaitFor(unsigned state, i2c::Address address);
  Result<Bytes> Fetch(std::size_t count, i2c::Address address);
  // Passes a result on; after a failure the engine is freed first.
  template <class Answer>
  Answer FreedAfter(Answer answer);

  Transport& transport_;
  const MeterTiming& timing_;
};

}  // namespace lightcal::devices::mcp2221
