// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display_meter.h"

#include <algorithm>

namespace lightcal::devices {
namespace {

class DisplayMeter final : public Meter {
 public:
  DisplayMeter(const DisplayProtocol& protocol, Transport& transport, const MeterSetup& setup)
      : protocol_(protocol),
        transport_(transport),
        search_(protocol.search),
        device_(std::string(protocol.driver) + ":" +
                (setup.serial.empty() ? std::string(protocol.model) : setup.serial)) {
    search_.wait = setup.timing.reply;
  }

  Result<MeterIdentity> Identify() override {
    return MeterIdentity{std::string(protocol_.model), "", {}};
  }
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  Result<void> Send(std::span<const std::byte> command);
  Result<MeterReading> Try(const Cancellation& cancellation);

  const DisplayProtocol& protocol_;
  Transport& transport_;
  FrameSearch search_;
  std::string device_;
};

Result<void> DisplayMeter::Send(std::span<const std::byte> command) {
  while (!command.empty()) {
    const std::size_t count = std::min(protocol_.bytes_a_write, command.size());
    if (auto sent = transport_.Write(command.first(count), search_.wait); !sent) return sent;
    command = command.subspan(count);
  }
  return {};
}

Result<MeterReading> DisplayMeter::Try(const Cancellation& cancellation) {
  ForgetQueued(transport_);
  const auto measure = [&]() -> Result<MeterReading> {
    if (auto begun = Send(protocol_.begin); !begun) return tl::unexpected(begun.error());
    return FirstDecoded(transport_, search_, protocol_.most_frames, cancellation,
                        [&](const Bytes& frame) { return protocol_.reading(frame, device_); });
  };
  auto reading = measure();
  if (!reading && IsGone(reading.error())) return reading;
  const auto ended = Send(protocol_.end);
  if (reading && !ended) {
    reading->warnings.push_back({"not_restored", device_,
                                 "live mode could not be ended (" + ended.error().message +
                                     "); switch the meter off and on"});
  }
  return reading;
}

Result<MeterReading> DisplayMeter::Measure(const Cancellation& cancellation) {
  for (int i = 1;; ++i) {
    auto reading = Try(cancellation);
    if (reading || reading.error().code != kBadReply || i >= protocol_.most_tries) return reading;
  }
}

}  // namespace

std::unique_ptr<Meter> MakeDisplayMeter(const DisplayProtocol& protocol, Transport& transport,
                                        const MeterSetup& setup) {
  return std::make_unique<DisplayMeter>(protocol, transport, setup);
}

}  // namespace lightcal::devices
