// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/gm1020/frame.h"

namespace lightcal::devices::gm1020 {
namespace {

constexpr DisplayLimits kLimits{.sigma_relative = 0.05, .highest_lx = 200000.0};

Result<MeterReading> ReadingFrom(const Bytes& frame, const std::string& device) {
  const auto live = DecodeLive(frame);
  if (!live) return tl::unexpected(live.error());
  return ReadingFromDisplay(live->shown, kLimits, device);
}

}  // namespace

constexpr DisplayProtocol kProtocol{
    .driver = "gm1020",
    .model = "GM1020",
    .search = {.frame_bytes = kFrameBytes,
               .may_begin = MayBeginFrame,
               .most_bytes = 8 * kFrameBytes,
               .waits = 3,
               .hint = "switch the meter off, plug its cable in, then switch it on"},
    .most_frames = 4,  // 2 s
    .begin = kStartLive,
    .end = kStopLive,
    .bytes_a_write = 1,  // as the meter wants it
    .reading = ReadingFrom};

}  // namespace lightcal::devices::gm1020
