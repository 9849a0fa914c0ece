// SPDX-License-Identifier: Apache-2.0
// The dialogue with a Sekonic C-700, C-800 or C-7000. README.md tells the protocol.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/sekonic/frame.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::sekonic {

// Errors besides the transport's own: nak, bad_reply (after one more try), wrong_ring, button_held,
// busy (not idle in time), hardware_error, interrupted.
class SekonicMeter final : public Meter {
 public:
  // `transport` outlives the meter. The serial may be empty; then the model names the device.
  SekonicMeter(Transport& transport, const MeterSetup& setup)
      : transport_(transport), serial_(setup.serial), timing_(setup.timing) {}

  Result<MeterIdentity> Identify() override;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;
  // A C-7000 only. Experimental: known from one public driver, never tried; the reading warns.
  Result<MeterReading> ReadMemory(int index, const Cancellation& cancellation) override;

 private:
  Result<Bytes> ReadReply();
  // Sends a command and returns its reply, acknowledged and echoed.
  Result<Bytes> Exchange(std::string_view command);
  Result<void> Order(std::string_view command);
  // A question whose reply `decode` understands; a damaged reply is asked for once more.
  template <class Decode>
  auto Ask(std::string_view command, Decode decode) -> decltype(decode(Bytes()));
  // Reads until silence, so that a late reply is not taken for the next one's.
  void Drain();

  // While the meter calibrates its dark signal it waits kDarkPatience times as long.
  Result<void> WaitUntilIdle(int polls, const Cancellation& cancellation);
  Result<void> SetUpC7000();
  Result<Measurement> MeasureRemotely(const Cancellation& cancellation);
  [[nodiscard]] Result<void> CheckUsable(const State& state) const;
  [[nodiscard]] std::string DeviceName() const;

  Transport& transport_;
  std::string serial_;
  MeterTiming timing_;
  std::string model_;             // known after Identify
  bool calibrated_dark_ = false;  // during this measurement
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::sekonic
