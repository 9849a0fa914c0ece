// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/i2c_sensors/sensor.h"

#include <array>
#include <string>
#include <utility>

#include "lightcal_devices/meters/i2c_sensors/bh1750.h"
#include "lightcal_devices/meters/i2c_sensors/opt3001.h"
#include "lightcal_devices/meters/i2c_sensors/opt4048.h"
#include "lightcal_devices/meters/i2c_sensors/veml7700.h"

namespace lightcal::devices::i2c {
namespace {

constexpr std::array<Address, 3> kOpt4048Addresses = {0x44, 0x45, 0x46};
constexpr std::array<Address, 4> kOpt3001Addresses = {0x44, 0x45, 0x46, 0x47};
constexpr std::array<Address, 2> kBh1750Addresses = {0x23, 0x5C};
constexpr std::array<Address, 1> kVeml7700Addresses = {0x10};

constexpr std::array<Sensor, 4> kSensors = {{
    {.name = "opt4048",
     .model = "OPT4048",
     .addresses = kOpt4048Addresses,
     .is_here = opt4048::IsHere,
     .measure = opt4048::Measure},
    {.name = "opt3001",
     .model = "OPT3001",
     .addresses = kOpt3001Addresses,
     .is_here = opt3001::IsHere,
     .measure = opt3001::Measure},
    {.name = "bh1750",
     .model = "BH1750",
     .addresses = kBh1750Addresses,
     .is_here = nullptr,
     .measure = bh1750::Measure},
    {.name = "veml7700",
     .model = "VEML7700",
     .addresses = kVeml7700Addresses,
     .is_here = nullptr,
     .measure = veml7700::Measure},
}};

}  // namespace

std::span<const Sensor> SensorTable() { return kSensors; }

const Sensor* FindSensor(std::string_view name) {
  for (const Sensor& sensor : kSensors) {
    if (sensor.name == name) return &sensor;
  }
  return nullptr;
}

Result<void> CheckNotCancelled(const SensorContext& context, std::string_view sensor) {
  if (!context.cancellation.Requested()) return {};
  return Failed("interrupted", std::string(sensor), "stopped by you; the sensor is released");
}

Result<SensorLight> PollForLight(const SensorContext& context, const std::string& sensor,
                                 const Polls& polls,
                                 const std::function<Result<std::optional<SensorLight>>()>& ask) {
  for (int i = 0; i < polls.count; ++i) {
    if (auto go_on = CheckNotCancelled(context, sensor); !go_on) return Propagate(std::move(go_on));
    context.timing.Pause(polls.pause);
    auto light = ask();
    if (!light) return Propagate(std::move(light));
    if (*light) return **light;
  }
  return Failed("not_ready", sensor,
                "no measurement in " + std::to_string(polls.count) + " questions; try again");
}

Result<bool> SaysId(const Result<std::uint16_t>& answer, std::uint16_t id) {
  if (answer) return *answer == id;
  if (answer.error().code == kNack) return false;
  return tl::unexpected(answer.error());
}

}  // namespace lightcal::devices::i2c
