// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/pce174/frame.h"

namespace lightcal::devices::pce174 {
namespace {

constexpr double kSigmaRelative = 0.05;

// The end of the range that a measurement was made in.
DisplayLimits LimitsOf(const DisplayedIlluminance& raw) {
  return {kSigmaRelative, LuxFromDisplay({kHighestCounts, raw.decimals, raw.footcandles})};
}

Result<MeterReading> ReadingFrom(const Bytes& frame, const std::string& device) {
  const auto measurement = DecodeMeasurement(frame);
  if (!measurement) return tl::unexpected(measurement.error());
  if (!measurement->mode.empty()) return FrozenDisplay(measurement->mode, device);
  if (measurement->negative) return NegativeReading(device);
  MeterReading reading = ReadingFromDisplay(measurement->raw, LimitsOf(measurement->raw), device);
  if (measurement->battery_low) reading.warnings.push_back(BatteryLow(device));
  return reading;
}

}  // namespace

constexpr DisplayProtocol kProtocol{
    .driver = "pce174",
    .model = "PCE-174",
    .search = {.frame_bytes = kFrameBytes,
               .may_begin = MayBeginFrame,
               .most_bytes = 6 * kFrameBytes,
               .hint = "is the meter switched on (it switches itself off), and is this its port?"},
    .most_tries = 2,
    .begin = kReadCommand,
    .reading = ReadingFrom};

}  // namespace lightcal::devices::pce174
