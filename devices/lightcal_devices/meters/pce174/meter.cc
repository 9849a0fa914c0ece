// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/pce174/meter.h"

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/frame_search.h"

namespace lightcal::pce174 {
namespace {

constexpr double kSigmaRelative = 0.05;
constexpr std::size_t kMostBytes = 6 * kFrameBytes;

FrameSearch Search(const MeterTiming& timing) {
  return {.frame_bytes = kFrameBytes,
          .may_begin = MayBeginFrame,
          .most_bytes = kMostBytes,
          .waits = 1,
          .wait = timing.reply,
          .hint = "is the meter switched on (it switches itself off), and is this its port?",
          .passing = ""};
}

// The end of the range that a measurement was made in.
DisplayLimits LimitsOf(const DisplayedIlluminance& raw) {
  return {kSigmaRelative, LuxFromDisplay({kHighestCounts, raw.decimals, raw.footcandles})};
}

}  // namespace

Result<MeterIdentity> Pce174Meter::Identify() { return MeterIdentity{kModel, "", {}}; }

Result<Measurement> Pce174Meter::Ask(const Cancellation& cancellation) {
  ForgetQueued(transport_);
  if (auto sent = transport_.Write(kReadCommand, timing_.reply); !sent) {
    return tl::unexpected(sent.error());
  }
  const auto reply = FindFrame(transport_, Search(timing_), cancellation);
  if (!reply) return tl::unexpected(reply.error());
  return DecodeMeasurement(*reply);
}

Result<MeterReading> Pce174Meter::Measure(const Cancellation& cancellation) {
  auto measurement = Ask(cancellation);
  if (!measurement && measurement.error().code == kBadReply) measurement = Ask(cancellation);
  if (!measurement) return tl::unexpected(measurement.error());
  if (!measurement->mode.empty()) {
    return Failed("hold", device_,
                  "the meter shows " + std::string(measurement->mode) +
                      ", not what it measures now; press that button until it is gone");
  }
  if (measurement->negative) return NegativeReading(device_);
  MeterReading reading = ReadingFromDisplay(measurement->raw, LimitsOf(measurement->raw), device_);
  if (measurement->battery_low) reading.warnings.push_back(BatteryLow(device_));
  return reading;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Pce174Meter>(transport, setup);
}

}  // namespace lightcal::pce174
