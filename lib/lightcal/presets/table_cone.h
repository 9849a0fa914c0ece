// SPDX-License-Identifier: Apache-2.0
// The point or spot that engines without measured distributions are given instead of one.
#pragma once

#include <optional>

#include "lightcal/light/intensity_table.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {

// Of the table's intensity along its aim (gamma = 0).
struct TableSubstitute {
  std::optional<SpotCone> cone;  // of the squared-linear profile; absent = a point strays less
  double worst = 0.0;  // largest |substitute - table| in any direction, over the axial intensity
  double flux = 1.0;   // the substitute's over the table's
};

// The cone that RefitCone finds; a point where that strays less in worst error and flux together.
// Absent: a table that is dark along its aim.
[[nodiscard]] std::optional<TableSubstitute> SubstituteForTable(const IntensityTable& table);

}  // namespace lightcal
