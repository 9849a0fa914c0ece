// SPDX-License-Identifier: Apache-2.0
// Listening to a Lutron light meter, which sends its display about once a second. README.md tells
// the protocol.
#pragma once

#include <memory>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::lutron16 {

// For the meter table; `transport` outlives the meter. Its errors besides the transport's own:
// bad_reply, wrong_unit, no_light_display (only the lower display is sent), negative_reading,
// interrupted.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::lutron16
