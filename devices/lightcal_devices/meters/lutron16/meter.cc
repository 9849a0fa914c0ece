// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/lutron16/frame.h"

namespace lightcal::devices::lutron16 {
namespace {

constexpr DisplayLimits kLimits{.sigma_relative = 0.05, .highest_lx = 100000.0};
constexpr const char* kNoLightDisplay = "no_light_display";

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

constexpr DisplayProtocol kProtocol{
    .driver = "lutron16",
    .model = "Lutron",
    .search = {.frame_bytes = kFrameBytes,
               .may_begin = MayBeginFrame,
               .most_bytes = 6 * kFrameBytes,
               .waits = 3,
               .hint = "is the meter switched on, and is its cable one made for it (the plug holds "
                       "a resistor of 2.2 kOhm)?",
               .passing = kNoLightDisplay},
    .most_frames = 6,  // three of each display
    .reading = ReadingFrom};

}  // namespace lightcal::devices::lutron16
