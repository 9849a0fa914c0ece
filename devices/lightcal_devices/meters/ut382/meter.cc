// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/ut382/meter.h"

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/ut382/frame.h"

namespace lightcal::ut382 {
namespace {

constexpr DisplayLimits kLimits{.sigma_relative = 0.05, .highest_lx = 20000.0};
constexpr int kMostFrames = 16;  // 2 s
constexpr int kSilences = 3;
constexpr std::size_t kMostBytes = 4 * (kFrameBytes + 1);
constexpr const char* kInMenu = "in_menu";

FrameSearch Search(const MeterTiming& timing) {
  return {.frame_bytes = kFrameBytes,
          .may_begin = MayBeginFrame,
          .most_bytes = kMostBytes,
          .waits = kSilences,
          .wait = timing.reply,
          .hint =
              "switch the meter's USB on (hold the menu button, press +, then menu five "
              "times): USB must show on its display",
          .passing = kInMenu};
}

Result<MeterReading> ReadingFrom(const Display& display, const std::string& device) {
  if (display.in_menu) {
    return Failed(kInMenu, device, "the meter shows a menu; leave it and try again");
  }
  if (!display.frozen.empty()) {
    return Failed("hold", device,
                  "the meter shows " + std::string(display.frozen) +
                      ", not what it measures now; press that button until it is gone");
  }
  if (display.overload && !display.automatic_range) {
    return Failed("overload", device,
                  "too bright for the range chosen by hand; choose a higher one, or AUTO");
  }
  MeterReading reading = display.overload ? OverRangeReading(kLimits.highest_lx, kLimits, device)
                                          : ReadingFromDisplay(display.shown, kLimits, device);
  if (display.battery_low) reading.warnings.push_back(BatteryLow(device));
  return reading;
}

}  // namespace

Result<MeterIdentity> Ut382Meter::Identify() { return MeterIdentity{kModel, "", {}}; }

Result<MeterReading> Ut382Meter::Measure(const Cancellation& cancellation) {
  ForgetQueued(transport_);
  return FirstDecoded(transport_, Search(timing_), kMostFrames, cancellation,
                      [&](const Bytes& frame) -> Result<MeterReading> {
                        const auto display = DecodeDisplay(frame);
                        if (!display) return tl::unexpected(display.error());
                        return ReadingFrom(*display, device_);
                      });
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Ut382Meter>(transport, setup);
}

}  // namespace lightcal::ut382
