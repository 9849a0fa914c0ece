// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/iio/meter.h"

#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/transport/sysfs.h"

namespace lightcal::devices::iio {
namespace {

constexpr double kLowestCctKelvin = 1000.0;
constexpr double kHighestCctKelvin = 25000.0;

bool IsChromaticity(const Number& x, const Number& y) {
  return x.value > 0.0 && y.value > 0.0 && x.value + y.value < 1.0;
}

void SetIlluminance(const Number& measured, Reading& reading) {
  reading.under_range = measured.value <= 0.0;
  if (reading.under_range) {
    reading.illuminance = Lux(measured.step);  // less than one count
    reading.sigma_relative = kSigmaRelative;
    return;
  }
  reading.illuminance = Lux(measured.value);
  // A count stands for an interval; its standard deviation is the step over sqrt(12).
  const double digit = measured.step / measured.value / std::sqrt(12.0);
  reading.sigma_relative = std::hypot(kSigmaRelative, digit);
}

}  // namespace

Result<std::optional<std::string>> IioMeter::Text(const std::string& attribute) {
  if (auto chosen = transport_.Write(AsBytes(attribute), timing_.reply); !chosen) {
    return tl::unexpected(chosen.error());
  }
  auto bytes = transport_.Read(kSysfsAttributeBytes, timing_.reply);
  // Silence of the sensor is worth one more question.
  if (!bytes && bytes.error().code == fault::kTimeout) {
    bytes = transport_.Read(kSysfsAttributeBytes, timing_.reply);
  }
  if (!bytes && bytes.error().code == fault::kNoAttribute) return std::nullopt;
  if (!bytes) return tl::unexpected(bytes.error());
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Result<std::optional<Number>> IioMeter::Ask(const std::string& attribute) {
  const auto text = Text(attribute);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return std::nullopt;
  const auto number = DecodeNumber(**text, attribute);
  if (!number) return tl::unexpected(number.error());
  return *number;
}

Result<std::optional<Number>> IioMeter::AskChannel(const std::string& prefix,
                                                   const std::string& shared) {
  Channel channel;
  const std::pair<std::string, std::optional<Number>*> parts[] = {
      {prefix + "_input", &channel.input},
      {prefix + "_raw", &channel.raw},
      {shared + "_offset", &channel.offset},
      {shared + "_scale", &channel.scale}};
  for (const auto& [attribute, part] : parts) {
    auto number = Ask(attribute);
    if (!number) return number;
    *part = *number;
    if (channel.input) break;
    if (part == &channel.raw && !channel.raw) break;
  }
  return ValueOf(channel);
}

Result<MeterIdentity> IioMeter::Identify() {
  auto text = Text("name");
  if (!text) return Propagate(std::move(text));
  name_ = text->value_or("");
  std::erase_if(name_, [](char c) { return c <= ' ' || c > '~'; });
  if (name_.empty()) name_ = "sensor";
  return MeterIdentity{name_, "", {}};
}

Result<void> IioMeter::AddColor(MeterReading& result) {
  const auto cct = AskChannel("in_colortemp", "in_colortemp");
  if (!cct) return tl::unexpected(cct.error());
  const auto x = AskChannel("in_chromaticity_x", "in_chromaticity");
  if (!x) return tl::unexpected(x.error());
  const auto y = *x ? AskChannel("in_chromaticity_y", "in_chromaticity") : x;
  if (!y) return tl::unexpected(y.error());
  Reading& reading = result.reading;
  const bool has_xy = *x && *y;
  if (has_xy && !IsChromaticity(**x, **y)) {
    result.warnings.push_back({"bad_chromaticity", reading.device,
                               "the sensor's x and y are no colour, so its colour is left out"});
    return {};
  }
  if (has_xy) reading.xy = Xy{(*x)->value, (*y)->value};
  if (!*cct) return {};
  const double kelvin = (*cct)->value;
  if (kelvin >= kLowestCctKelvin && kelvin <= kHighestCctKelvin) {
    reading.cct = Kelvin(kelvin);
  } else {
    result.warnings.push_back({"cct_out_of_range", reading.device,
                               RoundedText(kelvin, 4) + " K is no colour temperature of a lamp; "
                                                        "it is left out"});
  }
  return {};
}

Result<MeterReading> IioMeter::Measure(const Cancellation& cancellation) {
  if (name_.empty()) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  std::optional<Number> measured;
  for (int reads = 0; reads < 2; ++reads) {
    if (cancellation.Requested()) return Failed("interrupted", "iio:" + name_, "stopped by you");
    if (reads > 0) timing_.Pause(timing_.poll);
    auto value = AskChannel("in_illuminance", "in_illuminance");
    if (!value) return Propagate(std::move(value));
    measured = *value;
  }
  const std::string device = "iio:" + (serial_.empty() ? name_ : serial_);
  if (!measured) {
    return Failed(std::string(fault::kNoAttribute), device,
                  "the sensor has no in_illuminance; its in_intensity has no unit and is not used");
  }
  if (measured->value < 0.0) {
    return Failed(std::string(kBadReply), device,
                  "the sensor gave less than no light; try again, then reload its driver");
  }
  MeterReading result;
  result.reading.device = device;
  result.reading.quality = MeterQuality::kBareSensor;
  SetIlluminance(*measured, result.reading);
  if (result.reading.under_range) return result;
  if (auto added = AddColor(result); !added) return tl::unexpected(added.error());
  return result;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<IioMeter>(transport, setup);
}

}  // namespace lightcal::devices::iio
