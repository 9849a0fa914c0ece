// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/gm1020/meter.h"

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/gm1020/frame.h"

namespace lightcal::gm1020 {
namespace {

constexpr DisplayLimits kLimits{.sigma_relative = 0.05, .highest_lx = 200000.0};
constexpr int kMostFrames = 4;  // 2 s
constexpr int kSilences = 3;
constexpr std::size_t kMostBytes = 8 * kFrameBytes;

FrameSearch Search(const MeterTiming& timing) {
  return {.frame_bytes = kFrameBytes,
          .may_begin = MayBeginFrame,
          .most_bytes = kMostBytes,
          .waits = kSilences,
          .wait = timing.reply,
          .hint = "switch the meter off, plug its cable in, then switch it on",
          .passing = ""};
}

}  // namespace

Result<MeterIdentity> Gm1020Meter::Identify() { return MeterIdentity{kModel, "", {}}; }

Result<void> Gm1020Meter::Send(std::span<const std::byte> command) {
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (auto sent = transport_.Write(command.subspan(i, 1), timing_.reply); !sent) return sent;
  }
  return {};
}

Result<MeterReading> Gm1020Meter::Measure(const Cancellation& cancellation) {
  ForgetQueued(transport_);
  const auto measure = [&]() -> Result<LiveMeasurement> {
    if (auto started = Send(StartLive()); !started) return tl::unexpected(started.error());
    return FirstDecoded(transport_, Search(timing_), kMostFrames, cancellation,
                        [](const Bytes& frame) { return DecodeLive(frame); });
  };
  const auto live = measure();
  if (!live && IsGone(live.error())) return tl::unexpected(live.error());
  const auto stopped = Send(StopLive());
  if (!live) return tl::unexpected(live.error());
  MeterReading reading = ReadingFromDisplay(live->shown, kLimits, device_);
  if (!stopped) {
    reading.warnings.push_back({"not_restored", device_,
                                "live mode could not be ended (" + stopped.error().message +
                                    "); switch the meter off and on"});
  }
  return reading;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Gm1020Meter>(transport, setup);
}

}  // namespace lightcal::gm1020
