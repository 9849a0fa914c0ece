// SPDX-License-Identifier: Apache-2.0
// The dialogue with a HID ambient light sensor. README.md tells the protocol.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightcal_devices/meters/hid_als/frame.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::hid_als {

// 1 sigma of a light sensor whose maker promises nothing: no cosine corrector, often behind a
// display's glass.
inline constexpr double kSigmaRelative = 0.30;

// Errors besides the transport's own: bad_descriptor, bad_reply (after one more try), not_ready,
// access_denied, sensor_error, interrupted.
class HidAlsMeter final : public Meter {
 public:
  // `transport` is one of transport/hid.h and outlives the meter.
  HidAlsMeter(Transport& transport, const MeterSetup& setup)
      : transport_(transport), serial_(setup.serial), timing_(setup.timing) {}

  Result<MeterIdentity> Identify() override;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  // A feature report as it was, to be put back.
  struct Former {
    Bytes report;
  };
  Result<void> PowerUp(std::vector<Former>& former);
  void Restore(const std::vector<Former>& former, MeterReading* reading);
  Result<AmbientLight> WaitForLight(const Cancellation& cancellation);
  // The next input report; asked for when none comes by itself.
  Result<Bytes> NextReport();
  [[nodiscard]] MeterReading ReadingOf(const AmbientLight& light) const;
  [[nodiscard]] std::string DeviceName() const;

  Transport& transport_;
  std::string serial_;
  MeterTiming timing_;
  std::optional<Layout> layout_;  // known after Identify
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::hid_als
