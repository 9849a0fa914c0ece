// SPDX-License-Identifier: Apache-2.0
// The dialogue with a Benetech GM1020. README.md tells the protocol.
#pragma once

#include <memory>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::gm1020 {

// For the meter table; `transport` outlives the meter. Its errors besides the transport's own:
// bad_reply, interrupted. Live mode is always ended, also after an error or a cancellation; where
// that fails a reading warns of not_restored.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::gm1020
