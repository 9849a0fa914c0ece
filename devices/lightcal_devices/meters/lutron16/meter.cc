// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/lutron16/meter.h"

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/lutron16/frame.h"

namespace lightcal::lutron16 {
namespace {

constexpr DisplayLimits kLimits{.sigma_relative = 0.05, .highest_lx = 100000.0};
constexpr int kMostFrames = 6;  // three of each display
constexpr int kSilences = 3;
constexpr std::size_t kMostBytes = 6 * kFrameBytes;
constexpr const char* kNoLightDisplay = "no_light_display";

FrameSearch Search(const MeterTiming& timing) {
  return {.frame_bytes = kFrameBytes,
          .may_begin = MayBeginFrame,
          .most_bytes = kMostBytes,
          .waits = kSilences,
          .wait = timing.reply,
          .hint =
              "is the meter switched on, and is its cable one made for it (the plug holds a "
              "resistor of 2.2 kOhm)?",
          .passing = kNoLightDisplay};
}

Result<MeterReading> ReadingFrom(const Measurement& measurement, const std::string& device) {
  if (!measurement.upper_display) {
    return Failed(kNoLightDisplay, device,
                  "only the lower display is sent; switch the upper one to light");
  }
  if (measurement.negative) return NegativeReading(device);
  return ReadingFromDisplay(measurement.shown, kLimits, device);
}

}  // namespace

Result<MeterIdentity> Lutron16Meter::Identify() { return MeterIdentity{kModel, "", {}}; }

Result<MeterReading> Lutron16Meter::Measure(const Cancellation& cancellation) {
  ForgetQueued(transport_);
  return FirstDecoded(transport_, Search(timing_), kMostFrames, cancellation,
                      [&](const Bytes& frame) -> Result<MeterReading> {
                        const auto measurement = DecodeMeasurement(frame);
                        if (!measurement) return tl::unexpected(measurement.error());
                        return ReadingFrom(*measurement, device_);
                      });
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Lutron16Meter>(transport, setup);
}

}  // namespace lightcal::lutron16
