// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/hid_als/frame.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lightcal::devices::hid_als {
namespace {

constexpr Usage kAmbientLight = SensorUsage(0x0041);
constexpr Usage kIlluminance = SensorUsage(0x04D1);
constexpr Usage kColorTemperature = SensorUsage(0x04D2);
constexpr Usage kChromaticityX = SensorUsage(0x04D4);
constexpr Usage kChromaticityY = SensorUsage(0x04D5);
constexpr Usage kState = SensorUsage(0x0201);
constexpr Usage kReportingState = SensorUsage(0x0316);
constexpr Usage kAllEvents = SensorUsage(0x0841);
constexpr Usage kPowerState = SensorUsage(0x0319);
constexpr Usage kFullPower = SensorUsage(0x0851);

constexpr Usage kNotAvailable = SensorUsage(0x0802);
constexpr Usage kNoData = SensorUsage(0x0803);
constexpr Usage kInitializing = SensorUsage(0x0804);
constexpr Usage kAccessDenied = SensorUsage(0x0805);
constexpr Usage kSensorError = SensorUsage(0x0806);

// What a field tells: its usage, or for a selector that of the collection around it.
bool Tells(const Field& field, Usage usage) {
  if (field.choices.empty()) return field.usage == usage;
  return !field.collections.empty() && field.collections.back() == usage;
}

bool InAmbientLight(const Field& field) {
  return std::ranges::find(field.collections, kAmbientLight) != field.collections.end();
}

// The sensor's field of an input report, of report `number` where one is given.
std::optional<Field> FindInput(const ReportDescriptor& descriptor, Usage usage,
                               std::optional<std::uint8_t> number) {
  for (const Field& field : descriptor.fields) {
    if (field.kind == ReportKind::kInput && InAmbientLight(field) && Tells(field, usage) &&
        (!number || field.report == *number)) {
      return field;
    }
  }
  return std::nullopt;
}

void AddSwitch(const ReportDescriptor& descriptor, Usage property, Usage wanted, Layout& layout) {
  for (const Field& field : descriptor.fields) {
    if (field.kind != ReportKind::kFeature || !InAmbientLight(field) || !Tells(field, property)) {
      continue;
    }
    const auto choice = std::ranges::find(field.choices, wanted);
    if (choice == field.choices.end()) continue;
    layout.power_up.push_back({field, field.logical_min + (choice - field.choices.begin())});
    return;
  }
}

SensorState StateOf(const Layout& layout, std::span<const std::byte> report) {
  const auto state = layout.state ? layout.state->ChoiceIn(report) : std::nullopt;
  if (!state) return SensorState::kReady;  // the sensor does not say
  switch (*state) {
    case kNotAvailable:
    case kNoData:
    case kInitializing:
      return SensorState::kNotReady;
    case kAccessDenied:
      return SensorState::kAccessDenied;
    case kSensorError:
      return SensorState::kError;
    default:
      return SensorState::kReady;
  }
}

bool IsChromaticity(double value) { return value > 0.0 && value < 1.0; }

void AddColor(const Layout& layout, std::span<const std::byte> report, AmbientLight& light) {
  if (layout.cct) light.cct_K = layout.cct->ValueIn(report);
  if (light.cct_K && *light.cct_K <= 0.0) light.cct_K.reset();
  if (!layout.x || !layout.y) return;
  const auto x = layout.x->ValueIn(report);
  const auto y = layout.y->ValueIn(report);
  if (x && y && IsChromaticity(*x) && IsChromaticity(*y) && *x + *y <= 1.0) {
    light.xy = Xy{*x, *y};
    return;
  }
  light.color_dropped = true;
  light.cct_K.reset();
}

tl::unexpected<Error> BadReport(const std::string& what) {
  return Failed(std::string(kBadReply), "HID light sensor", what + "; try again");
}

}  // namespace

Result<Layout> FindAmbientLight(const ReportDescriptor& descriptor) {
  const auto illuminance = FindInput(descriptor, kIlluminance, std::nullopt);
  if (!illuminance) {
    return Failed(std::string(kBadDescriptor), "HID light sensor",
                  "its descriptor has no illuminance in any input report; nothing can be read");
  }
  Layout layout;
  layout.illuminance = *illuminance;
  layout.cct = FindInput(descriptor, kColorTemperature, illuminance->report);
  layout.x = FindInput(descriptor, kChromaticityX, illuminance->report);
  layout.y = FindInput(descriptor, kChromaticityY, illuminance->report);
  layout.state = FindInput(descriptor, kState, illuminance->report);
  layout.numbered = descriptor.numbered;
  layout.input_bytes = descriptor.ReportBytes(ReportKind::kInput, illuminance->report);
  AddSwitch(descriptor, kPowerState, kFullPower, layout);
  AddSwitch(descriptor, kReportingState, kAllEvents, layout);
  return layout;
}

Result<AmbientLight> DecodeInput(const Layout& layout, std::span<const std::byte> report) {
  if (report.size() < layout.input_bytes) {
    return BadReport("a report of " + std::to_string(report.size()) + " bytes, not " +
                     std::to_string(layout.input_bytes));
  }
  if (layout.numbered && std::to_integer<std::uint8_t>(report[0]) != layout.illuminance.report) {
    return BadReport("a report of another number");
  }
  AmbientLight light;
  light.state = StateOf(layout, report);
  if (light.state != SensorState::kReady) return light;
  const auto illuminance = layout.illuminance.ValueIn(report);
  if (!illuminance || *illuminance < 0.0) {
    return BadReport("an illuminance outside the range the sensor declares");
  }
  light.illuminance_lx = *illuminance;
  light.step_lx = std::pow(10.0, layout.illuminance.unit_exponent);
  light.over_range = layout.illuminance.RawIn(report) == layout.illuminance.logical_max;
  AddColor(layout, report, light);
  return light;
}

}  // namespace lightcal::devices::hid_als
