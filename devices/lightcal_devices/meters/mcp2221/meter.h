// SPDX-License-Identifier: Apache-2.0
// A light sensor chip on a MCP2221A bridge. README.md tells the protocol.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "lightcal_devices/meters/i2c_sensors/sensor.h"
#include "lightcal_devices/meters/mcp2221/bridge.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::mcp2221 {

// 1 sigma of a bare sensor chip: its scale by the maker, no cosine corrector, unknown lamp.
inline constexpr double kSigmaRelative = 0.20;

// Options: sensor (opt4048, opt3001, bh1750, veml7700; chips with an id are found without it) and
// address (0x23). Errors besides the bridge's: no_sensor, and wrong usage of the options.
class Mcp2221Meter final : public Meter {
 public:
  // `transport` is a HID device of transport/hid.h and outlives the meter.
  Mcp2221Meter(Transport& transport, const MeterSetup& setup)
      : serial_(setup.serial),
        options_(setup.options),
        timing_(setup.timing),
        bridge_(transport, timing_) {}

  Result<MeterIdentity> Identify() override;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  // Which chip sits where.
  Result<void> ChooseSensor();
  Result<void> FindAmong(std::span<const i2c::Sensor> sensors);
  // Whether a chip acknowledges its address.
  Result<bool> Answers(i2c::Address address);
  [[nodiscard]] Result<void> NoSensor();
  [[nodiscard]] std::string DeviceName() const;

  std::string serial_;
  std::map<std::string, std::string> options_;
  MeterTiming timing_;
  Bridge bridge_;
  const i2c::Sensor* sensor_ = nullptr;  // known after Identify
  i2c::Address address_ = 0;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::mcp2221
