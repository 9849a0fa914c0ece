// SPDX-License-Identifier: Apache-2.0
// Listening to a Lutron light meter, which sends its display about once a second. README.md tells
// the protocol.
#pragma once

#include <memory>
#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::lutron16 {

// Errors besides the transport's own: bad_reply, wrong_unit, no_light_display (only the lower
// display is sent), negative_reading, interrupted.
class Lutron16Meter final : public Meter {
 public:
  // `transport` outlives the meter. The meter has no serial number that it tells; a given one
  // names the device.
  Lutron16Meter(Transport& transport, const MeterSetup& setup)
      : transport_(transport),
        timing_(setup.timing),
        device_("lutron16:" + (setup.serial.empty() ? std::string(kModel) : setup.serial)) {}

  Result<MeterIdentity> Identify() override;  // asks nothing: the meter does not tell
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

  static constexpr const char* kModel = "Lutron";

 private:
  Transport& transport_;
  MeterTiming timing_;
  std::string device_;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::lutron16
