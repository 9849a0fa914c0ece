// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/pce174/meter.h"

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/pce174/frame.h"

namespace lightcal::pce174 {
namespace {

constexpr DisplayMeterName kName{.driver = "pce174", .model = "PCE-174"};
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

class Pce174Meter final : public DisplayMeter {
 public:
  using DisplayMeter::DisplayMeter;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  Result<Measurement> Ask(const Cancellation& cancellation);
};

Result<Measurement> Pce174Meter::Ask(const Cancellation& cancellation) {
  ForgetQueued(transport());
  if (auto sent = transport().Write(kReadCommand, timing().reply); !sent) {
    return tl::unexpected(sent.error());
  }
  const auto reply = FindFrame(transport(), Search(timing()), cancellation);
  if (!reply) return tl::unexpected(reply.error());
  return DecodeMeasurement(*reply);
}

Result<MeterReading> Pce174Meter::Measure(const Cancellation& cancellation) {
  auto measurement = Ask(cancellation);
  if (!measurement && measurement.error().code == kBadReply) measurement = Ask(cancellation);
  if (!measurement) return tl::unexpected(measurement.error());
  if (!measurement->mode.empty()) return FrozenDisplay(measurement->mode, device());
  if (measurement->negative) return NegativeReading(device());
  MeterReading reading = ReadingFromDisplay(measurement->raw, LimitsOf(measurement->raw), device());
  if (measurement->battery_low) reading.warnings.push_back(BatteryLow(device()));
  return reading;
}

}  // namespace

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Pce174Meter>(transport, setup, kName);
}

}  // namespace lightcal::pce174
