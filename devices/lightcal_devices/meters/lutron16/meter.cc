// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/lutron16/meter.h"

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/lutron16/frame.h"

namespace lightcal::lutron16 {
namespace {

constexpr DisplayMeterName kName{.driver = "lutron16", .model = "Lutron"};
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

Result<MeterReading> ReadingFrom(const Bytes& frame, const std::string& device) {
  const auto measurement = DecodeMeasurement(frame);
  if (!measurement) return tl::unexpected(measurement.error());
  if (!measurement->upper_display) {
    return Failed(kNoLightDisplay, device,
                  "only the lower display is sent; switch the upper one to light");
  }
  if (measurement->negative) return NegativeReading(device);
  return ReadingFromDisplay(measurement->shown, kLimits, device);
}

}  // namespace

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<StreamMeter>(
      transport, setup, kName,
      DisplayStream{
          .search = Search(setup.timing), .most_frames = kMostFrames, .reading = ReadingFrom});
}

}  // namespace lightcal::lutron16
