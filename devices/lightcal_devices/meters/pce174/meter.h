// SPDX-License-Identifier: Apache-2.0
// The dialogue with a PCE-174 or an Extech HD450. README.md tells the protocol.
#pragma once

#include <memory>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::pce174 {

// For the meter table; `transport` outlives the meter. Its errors besides the transport's own:
// bad_reply (after one more try), hold (the display is held, or shows MAX, MIN, PMAX, PMIN, REL or
// a stored value), negative_reading, interrupted.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::pce174
