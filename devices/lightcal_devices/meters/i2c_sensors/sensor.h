// SPDX-License-Identifier: Apache-2.0
// Light sensor chips on an I2C bus: what every one answers, and which there are.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal_devices/meters/i2c_sensors/i2c_bus.h"
#include "lightcal_devices/meters/meter.h"

namespace lightcal::devices::i2c {

// What a chip measured. Over or under range, illuminance_lx is the end of the range.
struct SensorLight {
  double illuminance_lx = 0.0;
  double step_lx = 0.0;  // one count at this setting
  bool over_range = false;
  bool under_range = false;
  std::optional<Xy> xy;
};

struct SensorContext {
  const MeterTiming& timing;
  const Cancellation& cancellation;
};

struct Sensor {
  std::string_view name;  // "opt4048", as the option sensor spells it
  std::string_view model;
  std::span<const Address> addresses;
  // Whether the chip at this address says it is this sensor; nullptr = it cannot say.
  // Fails as the bus does, i2c_nack aside, which is a no.
  Result<bool> (*is_here)(I2cBus& bus, Address address) = nullptr;
  // One measurement; the chip is left as it was found.
  // Fails: i2c_nack, bad_reply, not_ready, interrupted, and as the bus does.
  Result<SensorLight> (*measure)(I2cBus& bus, Address address,
                                 const SensorContext& context) = nullptr;
};

[[nodiscard]] std::span<const Sensor> SensorTable();
// nullptr = no such sensor.
[[nodiscard]] const Sensor* FindSensor(std::string_view name);

// interrupted, when the person wished so.
[[nodiscard]] Result<void> CheckNotCancelled(const SensorContext& context, std::string_view sensor);

// How often a sensor is asked whether it is done, and the pause before each time.
struct Polls {
  std::chrono::milliseconds pause{0};
  int count = 0;
};
// The first light that `ask` answers; it answers nothing while the measurement goes on.
// Fails: not_ready after all polls, interrupted, and as `ask`.
[[nodiscard]] Result<SensorLight> PollForLight(
    const SensorContext& context, const std::string& sensor, const Polls& polls,
    const std::function<Result<std::optional<SensorLight>>()>& ask);

// What an answer of the bus about an id register means: no one there is a no.
[[nodiscard]] Result<bool> SaysId(const Result<std::uint16_t>& answer, std::uint16_t id);

}  // namespace lightcal::devices::i2c
