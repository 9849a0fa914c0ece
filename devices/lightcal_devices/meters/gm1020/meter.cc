// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/gm1020/meter.h"

#include <span>

#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/gm1020/frame.h"

namespace lightcal::gm1020 {
namespace {

constexpr DisplayMeterName kName{.driver = "gm1020", .model = "GM1020"};
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

class Gm1020Meter final : public DisplayMeter {
 public:
  using DisplayMeter::DisplayMeter;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  // Byte by byte, as the meter wants it.
  Result<void> Send(std::span<const std::byte> command);
};

Result<void> Gm1020Meter::Send(std::span<const std::byte> command) {
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (auto sent = transport().Write(command.subspan(i, 1), timing().reply); !sent) return sent;
  }
  return {};
}

Result<MeterReading> Gm1020Meter::Measure(const Cancellation& cancellation) {
  ForgetQueued(transport());
  const auto measure = [&]() -> Result<LiveMeasurement> {
    if (auto started = Send(StartLive()); !started) return tl::unexpected(started.error());
    return FirstDecoded(transport(), Search(timing()), kMostFrames, cancellation,
                        [](const Bytes& frame) { return DecodeLive(frame); });
  };
  const auto live = measure();
  if (!live && IsGone(live.error())) return tl::unexpected(live.error());
  const auto stopped = Send(StopLive());
  if (!live) return tl::unexpected(live.error());
  MeterReading reading = ReadingFromDisplay(live->shown, kLimits, device());
  if (!stopped) {
    reading.warnings.push_back({"not_restored", device(),
                                "live mode could not be ended (" + stopped.error().message +
                                    "); switch the meter off and on"});
  }
  return reading;
}

}  // namespace

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Gm1020Meter>(transport, setup, kName);
}

}  // namespace lightcal::gm1020
