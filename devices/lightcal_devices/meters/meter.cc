// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/meter.h"

#include <thread>

namespace lightcal {

void MeterTiming::Pause(std::chrono::milliseconds duration) const {
  if (live) std::this_thread::sleep_for(duration);
}

}  // namespace lightcal
