// SPDX-License-Identifier: Apache-2.0
// The dialogue with a Benetech GM1020. README.md tells the protocol.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::gm1020 {

// Errors besides the transport's own: bad_reply, interrupted. Live mode is always ended, also after
// an error or a cancellation; where that fails a reading warns of not_restored.
class Gm1020Meter final : public Meter {
 public:
  // `transport` outlives the meter. The meter has no serial number that it tells; a given one
  // names the device.
  Gm1020Meter(Transport& transport, const MeterSetup& setup)
      : transport_(transport),
        timing_(setup.timing),
        device_("gm1020:" + (setup.serial.empty() ? std::string(kModel) : setup.serial)) {}

  Result<MeterIdentity> Identify() override;  // asks nothing: the meter does not tell
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

  static constexpr const char* kModel = "GM1020";

 private:
  // Byte by byte, as the meter wants it.
  Result<void> Send(std::span<const std::byte> command);

  Transport& transport_;
  MeterTiming timing_;
  std::string device_;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::gm1020
