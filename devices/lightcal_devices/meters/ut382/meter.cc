// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/ut382/frame.h"

namespace lightcal::devices::ut382 {
namespace {

constexpr DisplayLimits kLimits{.sigma_relative = 0.05, .highest_lx = 20000.0};
constexpr const char* kInMenu = "in_menu";

Result<MeterReading> ReadingFrom(const Bytes& frame, const std::string& device) {
  const auto display = DecodeDisplay(frame);
  if (!display) return tl::unexpected(display.error());
  if (display->in_menu) {
    return Failed(kInMenu, device, "the meter shows a menu; leave it and try again");
  }
  if (!display->frozen.empty()) return FrozenDisplay(display->frozen, device);
  if (display->overload && !display->automatic_range) {
    return Failed("overload", device,
                  "too bright for the range chosen by hand; choose a higher one, or AUTO");
  }
  MeterReading reading = display->overload ? OverRangeReading(kLimits.highest_lx, kLimits, device)
                                           : ReadingFromDisplay(display->shown, kLimits, device);
  if (display->battery_low) reading.warnings.push_back(BatteryLow(device));
  return reading;
}

}  // namespace

constexpr DisplayProtocol kProtocol{
    .driver = "ut382",
    .model = "UT382",
    .search = {.frame_bytes = kFrameBytes,
               .may_begin = MayBeginFrame,
               .most_bytes = 4 * (kFrameBytes + 1),
               .waits = 3,
               .hint = "switch the meter's USB on (hold the menu button, press +, then menu five "
                       "times): USB must show on its display",
               .passing = kInMenu},
    .most_frames = 16,  // 2 s
    .reading = ReadingFrom};

}  // namespace lightcal::devices::ut382
