// SPDX-License-Identifier: Apache-2.0
// A preset's lights against the readings they were made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/presets/check/engine_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct ComparedReading {
  std::string light;
  int index = 0;  // among the readings of that light
  std::optional<double> distance_m;
  double measured_lx = 0.0, predicted_lx = 0.0;  // without the ambient light
  bool used = true;
};

// One row a reading, in the order of the lamps' residuals. `lamps` is what was fitted to `session`:
// it says where lamps that the file does not place stand. A photometric file may be of any make: it
// stands for every lamp, unless it names one.
[[nodiscard]] std::vector<ComparedReading> CompareWithReadings(const Session& session,
                                                               const LightFile& lamps,
                                                               std::vector<EngineLight> lights);

// Root mean square of measured/predicted - 1 over the used readings; 0 without any.
[[nodiscard]] double RmsOf(const std::vector<ComparedReading>& rows);

}  // namespace lightcal
