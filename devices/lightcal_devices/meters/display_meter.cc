// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display_meter.h"

#include <utility>

namespace lightcal {

DisplayMeter::DisplayMeter(Transport& transport, const MeterSetup& setup,
                           const DisplayMeterName& name)
    : transport_(transport),
      timing_(setup.timing),
      model_(name.model),
      device_(std::string(name.driver) + ":" + (setup.serial.empty() ? model_ : setup.serial)) {}

Result<MeterIdentity> DisplayMeter::Identify() { return MeterIdentity{model_, "", {}}; }

StreamMeter::StreamMeter(Transport& transport, const MeterSetup& setup,
                         const DisplayMeterName& name, DisplayStream stream)
    : DisplayMeter(transport, setup, name), stream_(std::move(stream)) {}

Result<MeterReading> StreamMeter::Measure(const Cancellation& cancellation) {
  ForgetQueued(transport());
  return FirstDecoded(transport(), stream_.search, stream_.most_frames, cancellation,
                      [&](const Bytes& frame) { return stream_.reading(frame, device()); });
}

}  // namespace lightcal
