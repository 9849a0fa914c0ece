// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/mcp2221/meter.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "lightcal/colorimetry/cct.h"

namespace lightcal::devices::mcp2221 {
namespace {

constexpr unsigned kLowestAddress = 0x08;
constexpr unsigned kHighestAddress = 0x77;

// "0x23", "23" (hexadecimal, as data sheets give it).
std::optional<i2c::Address> ParseAddress(std::string_view text) {
  if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
  unsigned value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  const bool is_number = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  if (!is_number || value < kLowestAddress || value > kHighestAddress) return std::nullopt;
  return static_cast<i2c::Address>(value);
}

std::string Hex(i2c::Address address) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%02x", static_cast<unsigned>(address));
  return text.data();
}

}  // namespace

std::string Mcp2221Meter::DeviceName() const {
  if (!serial_.empty()) return "mcp2221:" + serial_;
  return "mcp2221:" + std::string(sensor_ == nullptr ? "" : sensor_->model);
}

Result<bool> Mcp2221Meter::Answers(i2c::Address address) {
  const auto byte = bridge_.Read(address, 1);
  if (byte) return true;
  if (byte.error().code == i2c::kNack) return false;
  return tl::unexpected(byte.error());
}

Result<void> Mcp2221Meter::FindAmong(std::span<const i2c::Sensor> sensors) {
  for (const i2c::Sensor& sensor : sensors) {
    for (const i2c::Address address : sensor.addresses) {
      const auto here =
          sensor.is_here == nullptr ? Answers(address) : sensor.is_here(bridge_, address);
      if (!here) return tl::unexpected(here.error());
      if (!*here) continue;
      sensor_ = &sensor;
      address_ = address;
      return {};
    }
  }
  return {};
}

// A chip without an id may still sit there: its address is a hint, not a proof.
Result<void> Mcp2221Meter::NoSensor() {
  std::string hint;
  for (const i2c::Sensor& sensor : i2c::SensorTable()) {
    if (sensor.is_here != nullptr) continue;
    for (const i2c::Address address : sensor.addresses) {
      const auto here = Answers(address);
      if (!here) return tl::unexpected(here.error());
      if (*here) {
        hint += "; a chip answers at " + Hex(address) + ": if it is a " +
                std::string(sensor.model) +
                ", add {meter.option} sensor=" + std::string(sensor.name);
      }
    }
  }
  return Failed("no_sensor", "mcp2221",
                "no light sensor that tells its name (OPT4048, OPT3001) on the bus" +
                    (hint.empty() ? std::string("; check the wires (SDA, SCL, power)") : hint));
}

Result<void> Mcp2221Meter::ChooseSensor() {
  const auto name = options_.find("sensor");
  const auto where = options_.find("address");
  if (name == options_.end()) {
    if (where != options_.end()) {
      return WrongUsage("{meter.option} address",
                        "says where, not what: add {meter.option} sensor=bh1750");
    }
    for (const i2c::Sensor& sensor : i2c::SensorTable()) {
      if (sensor.is_here == nullptr) continue;
      if (auto looked = FindAmong({&sensor, 1}); !looked) return looked;
      if (sensor_ != nullptr) return {};
    }
    return NoSensor();
  }
  const i2c::Sensor* sensor = i2c::FindSensor(name->second);
  if (sensor == nullptr) {
    std::string known;
    for (const i2c::Sensor& row : i2c::SensorTable()) known += " " + std::string(row.name);
    return WrongUsage("{meter.option} sensor=" + name->second, "is none of" + known);
  }
  if (where != options_.end()) {
    const auto address = ParseAddress(where->second);
    if (!address) {
      return WrongUsage("{meter.option} address=" + where->second, "give 0x08 to 0x77, as 0x23");
    }
    sensor_ = sensor;
    address_ = *address;
    return {};
  }
  if (auto looked = FindAmong({sensor, 1}); !looked) return looked;
  if (sensor_ != nullptr) return {};
  return Failed(
      "no_sensor", "mcp2221",
      "no " + std::string(sensor->model) + " answers at " + Hex(sensor->addresses[0]) +
          "; check the wires (SDA, SCL, power), or name its address: {meter.option} address=0x..");
}

Result<MeterIdentity> Mcp2221Meter::Identify() {
  if (auto ready = bridge_.Prepare(); !ready) return tl::unexpected(ready.error());
  if (auto chosen = ChooseSensor(); !chosen) return tl::unexpected(chosen.error());
  return MeterIdentity{std::string(sensor_->model), "", {}};
}

Result<MeterReading> Mcp2221Meter::Measure(const Cancellation& cancellation) {
  if (sensor_ == nullptr) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  const auto light = sensor_->measure(bridge_, address_, {timing_, cancellation});
  if (!light) return tl::unexpected(light.error());
  MeterReading result;
  Reading& reading = result.reading;
  reading.device = DeviceName();
  reading.quality = MeterQuality::kBareSensor;
  reading.illuminance = Lux(light->illuminance_lx);
  reading.over_range = light->over_range;
  reading.under_range = light->under_range;
  const double digit = light->step_lx / std::sqrt(12.0) / light->illuminance_lx;
  reading.sigma_relative = std::hypot(kSigmaRelative, digit);
  if (!light->xy) return result;
  reading.xy = light->xy;
  reading.color_source = ColorSource::kColorimeter;
  if (const CctResult cct = CctFromXy(*light->xy); cct.valid()) {
    reading.cct = cct.temperature;
    reading.duv = cct.duv;
  }
  return result;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Mcp2221Meter>(transport, setup);
}

}  // namespace lightcal::devices::mcp2221
