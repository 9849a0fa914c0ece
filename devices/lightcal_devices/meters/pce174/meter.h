// SPDX-License-Identifier: Apache-2.0
// The dialogue with a PCE-174 or an Extech HD450. README.md tells the protocol.
#pragma once

#include <memory>
#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/pce174/frame.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::pce174 {

// Errors besides the transport's own: bad_reply (after one more try), hold (the display is held, or
// shows MAX, MIN, PMAX, PMIN, REL or a stored value), negative_reading, interrupted.
class Pce174Meter final : public Meter {
 public:
  // `transport` outlives the meter. The meter has no serial number that it tells; a given one
  // names the device.
  Pce174Meter(Transport& transport, const MeterSetup& setup)
      : transport_(transport),
        timing_(setup.timing),
        device_("pce174:" + (setup.serial.empty() ? std::string(kModel) : setup.serial)) {}

  Result<MeterIdentity> Identify() override;  // asks nothing: the meter does not tell
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

  static constexpr const char* kModel = "PCE-174";

 private:
  Result<Measurement> Ask(const Cancellation& cancellation);

  Transport& transport_;
  MeterTiming timing_;
  std::string device_;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::pce174
