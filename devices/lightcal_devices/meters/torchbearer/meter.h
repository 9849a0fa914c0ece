// SPDX-License-Identifier: Apache-2.0
// The dialogue with a Torch Bearer Y21B7W spectrometer: experimental. README.md tells the protocol.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/torchbearer/frame.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::torchbearer {

// Errors besides the transport's own: bad_reply (after one more try), nak, over_exposed and
// under_exposed (the automatic exposure found none that fits), interrupted.
class TorchbearerMeter final : public Meter {
 public:
  // `transport` outlives the meter. Without a serial the device's id names it.
  TorchbearerMeter(Transport& transport, const MeterSetup& setup)
      : transport_(transport), serial_(setup.serial), timing_(setup.timing) {}

  Result<MeterIdentity> Identify() override;
  // Streams until one measurement is well exposed, then ends the stream and gives the exposure back
  // to manual where it was; where that fails the reading warns of not_restored.
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  struct Answer {
    unsigned type = 0;
    Bytes data;
  };
  // The next whole message, of any type; bears so many silences before it.
  Result<Answer> ReadMessage(int silences, const Cancellation& cancellation);
  // The data of the next message of this type; others before it are passed over.
  Result<Bytes> ReadAnswer(MessageType type, const Cancellation& cancellation);
  Result<void> Send(MessageType type, std::span<const std::byte> data = {});
  // A question whose answer `decode` understands; a damaged one is asked for once more.
  template <class Decode>
  auto Ask(MessageType type, std::span<const std::byte> data, const Cancellation& cancellation,
           Decode decode) -> decltype(decode(Bytes()));
  Result<void> SetExposure(bool automatic, const Cancellation& cancellation);

  Result<Measurement> MeasureStreaming(const Cancellation& cancellation);
  // What the next message of the stream measures; nothing when it is no measurement.
  Result<std::optional<Measurement>> NextMeasurement(const Cancellation& cancellation);
  // The stream's end is acknowledged only when its last measurement was well exposed.
  Result<void> StopStreaming(bool acknowledged);
  Result<void> Restore(bool acknowledged, bool was_automatic);
  [[nodiscard]] std::string DeviceName() const;

  Transport& transport_;
  std::string serial_;
  MeterTiming timing_;
  std::string id_;  // known after Identify
  std::optional<WavelengthRange> range_;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::torchbearer
