// SPDX-License-Identifier: Apache-2.0
// Listening to a UNI-T UT382, which sends its display eight times a second. README.md tells the
// protocol.
#pragma once

#include <memory>
#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::ut382 {

// Errors besides the transport's own: bad_reply, in_menu, hold (or MAX, MIN shown), overload (in a
// range chosen by hand), interrupted.
class Ut382Meter final : public Meter {
 public:
  // `transport` outlives the meter. The meter has no serial number that it tells; a given one
  // names the device.
  Ut382Meter(Transport& transport, const MeterSetup& setup)
      : transport_(transport),
        timing_(setup.timing),
        device_("ut382:" + (setup.serial.empty() ? std::string(kModel) : setup.serial)) {}

  Result<MeterIdentity> Identify() override;  // asks nothing: the meter does not tell
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

  static constexpr const char* kModel = "UT382";

 private:
  Transport& transport_;
  MeterTiming timing_;
  std::string device_;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::ut382
