// SPDX-License-Identifier: Apache-2.0
// What every engine makes of a lamp where a meter stood.
#pragma once

#include <vector>

#include "lightcal/records/fitted_light.h"
#include "lightcal/report/report_extras.h"
#include "report/engines.h"

namespace lightcal::app {

// One row a light and engine, on the axis, facing the lamp, at the distance of its median used
// reading (1 m where none has one). Files that `check` can read give lux by their own meaning; of
// the others it is worked out here from the numbers they hold, with the engine's falloff
// (FalloffOf), its colour's luminance and the form it was given. Lights without an intensity or
// illuminance are left out.
[[nodiscard]] std::vector<ParityRow> ParityOf(const LightFile& lights,
                                              const std::vector<EngineExport>& exports);

}  // namespace lightcal::app
