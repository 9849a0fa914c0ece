// SPDX-License-Identifier: Apache-2.0
// Listening to a UNI-T UT382, which sends its display eight times a second. README.md tells the
// protocol.
#pragma once

#include <memory>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::ut382 {

// For the meter table; `transport` outlives the meter. Its errors besides the transport's own:
// bad_reply, in_menu, hold (or MAX, MIN shown), overload (in a range chosen by hand), interrupted.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::ut382
