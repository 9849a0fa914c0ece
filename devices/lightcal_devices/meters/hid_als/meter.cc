// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/hid_als/meter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/transport/hid.h"

namespace lightcal::devices::hid_als {
namespace {

constexpr int kMostReports = 20;  // until one tells the light
constexpr int kBadReportRetries = 1;
constexpr const char* kModel = "sensor";  // nothing tells its name

// Replays differ from what they were: not a device that lacks a report.
bool EndsDialogue(const Error& error) {
  return IsGone(error) || error.code == fault::kTapeMismatch || error.code == fault::kTapeEnded;
}

}  // namespace

std::string HidAlsMeter::DeviceName() const {
  return "hid_als:" + (serial_.empty() ? kModel : serial_);
}

Result<MeterIdentity> HidAlsMeter::Identify() {
  const auto bytes = transport_.Control("report_descriptor", {}, kLongestDescriptor, timing_.reply);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto descriptor = ParseReportDescriptor(*bytes);
  if (!descriptor) return tl::unexpected(descriptor.error());
  auto layout = FindAmbientLight(*descriptor);
  if (!layout) return Propagate(std::move(layout));
  layout_ = *std::move(layout);
  return MeterIdentity{kModel, "", {}};
}

// Sensors may sleep until a program asks for events. One that refuses is read as it is.
Result<void> HidAlsMeter::PowerUp(std::vector<Former>& former) {
  for (const Switch& change : layout_->power_up) {
    const std::array number = {static_cast<std::byte>(change.field.report)};
    auto report = transport_.Control("get_feature", number, kLongestHidReport, timing_.reply);
    if (!report && EndsDialogue(report.error())) return tl::unexpected(report.error());
    if (!report || report->empty()) continue;
    // hidapi puts a 0 before the bytes of a device without report numbers.
    const std::size_t skipped = layout_->numbered ? 0 : 1;
    const auto body = std::span(*report).subspan(skipped);
    if (change.field.RawIn(body) == change.raw) continue;
    Former before{*report};
    if (!change.field.Put(change.raw, body)) continue;
    const auto set = transport_.Control("set_feature", *report, 0, timing_.reply);
    if (set) former.push_back(std::move(before));
    if (!set && EndsDialogue(set.error())) return tl::unexpected(set.error());
  }
  return {};
}

void HidAlsMeter::Restore(const std::vector<Former>& former, MeterReading* reading) {
  for (auto it = former.rbegin(); it != former.rend(); ++it) {
    const auto set = transport_.Control("set_feature", it->report, 0, timing_.reply);
    if (set || reading == nullptr) continue;
    reading->warnings.push_back({"not_restored", DeviceName(),
                                 "the sensor could not be put back as it was (" +
                                     set.error().message + "); it may use more power"});
  }
}

Result<Bytes> HidAlsMeter::NextReport() {
  auto report = transport_.Read(kLongestHidReport, timing_.reply);
  if (report || report.error().code != fault::kTimeout) return report;
  const Error silent = report.error();
  const std::array number = {static_cast<std::byte>(layout_->illuminance.report)};
  auto asked = transport_.Control("get_input", number, kLongestHidReport, timing_.reply);
  if (!asked) {
    if (EndsDialogue(asked.error())) return asked;
    return tl::unexpected(silent);
  }
  if (!layout_->numbered && !asked->empty()) asked->erase(asked->begin());
  return asked;
}

Result<AmbientLight> HidAlsMeter::WaitForLight(const Cancellation& cancellation) {
  int bad = 0;
  for (int i = 0; i < kMostReports; ++i) {
    if (cancellation.Requested()) {
      return Failed("interrupted", DeviceName(), "stopped by you; the sensor is released");
    }
    const auto report = NextReport();
    if (!report) return tl::unexpected(report.error());
    const bool is_another =
        layout_->numbered && !report->empty() &&
        std::to_integer<unsigned>(report->front()) != layout_->illuminance.report;
    if (is_another) continue;  // of another sensor in the same device
    auto light = DecodeInput(*layout_, *report);
    if (!light && bad++ < kBadReportRetries) continue;
    if (!light) return light;
    switch (light->state) {
      case SensorState::kReady:
        return light;
      case SensorState::kNotReady:
        timing_.Pause(timing_.poll);
        continue;
      case SensorState::kAccessDenied:
        return Failed("access_denied", DeviceName(),
                      "the sensor refuses to be read; switch it on in the system's settings "
                      "(privacy), then try again");
      case SensorState::kError:
        return Failed("sensor_error", DeviceName(),
                      "the sensor reports an error; unplug it, plug it in and try again");
    }
  }
  return Failed("not_ready", DeviceName(),
                "no light in " + std::to_string(kMostReports) +
                    " reports: the sensor is starting or covered by another; try again");
}

MeterReading HidAlsMeter::ReadingOf(const AmbientLight& light) const {
  MeterReading result;
  Reading& reading = result.reading;
  reading.device = DeviceName();
  reading.quality = MeterQuality::kBareSensor;
  reading.illuminance = Lux(light.illuminance_lx);
  reading.over_range = light.over_range;
  reading.under_range = light.illuminance_lx < light.step_lx;
  if (reading.under_range) reading.illuminance = Lux(light.step_lx);
  const double digit = light.step_lx / std::sqrt(12.0) / reading.illuminance->value();
  reading.sigma_relative = std::hypot(kSigmaRelative, digit);
  if (reading.over_range || reading.under_range) return result;
  reading.xy = light.xy;
  if (light.cct_K) reading.cct = Kelvin(*light.cct_K);
  if (light.xy || light.cct_K) reading.color_source = ColorSource::kColorimeter;
  if (light.color_dropped) {
    result.warnings.push_back({"color_dropped", reading.device,
                               "the sensor's chromaticity is impossible (outside 0..1, or 0); its "
                               "colour is left out"});
  }
  return result;
}

Result<MeterReading> HidAlsMeter::Measure(const Cancellation& cancellation) {
  if (!layout_) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  std::vector<Former> former;
  const auto powered = PowerUp(former);
  auto light =
      powered ? WaitForLight(cancellation) : Result<AmbientLight>(tl::unexpected(powered.error()));
  if (!light) {
    if (!EndsDialogue(light.error())) Restore(former, nullptr);
    return Propagate(std::move(light));
  }
  MeterReading reading = ReadingOf(*light);
  Restore(former, &reading);
  return reading;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<HidAlsMeter>(transport, setup);
}

}  // namespace lightcal::devices::hid_als
