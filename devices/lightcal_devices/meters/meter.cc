// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/meter.h"

#include <thread>

namespace lightcal::devices {

void MeterTiming::Pause(std::chrono::milliseconds duration) const {
  if (live) std::this_thread::sleep_for(duration);
}

Result<MeterReading> Meter::ReadMemory(int /*index*/, const Cancellation& /*cancellation*/) {
  return Refused("no_memory", "meter",
                 "this driver does not read the meter's memory; export its readings to a file and "
                 "import that");
}

}  // namespace lightcal::devices
