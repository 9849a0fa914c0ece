// SPDX-License-Identifier: Apache-2.0
// A photometric table of which only some nodes are kept: less to store and look up.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/light/intensity_table.h"

namespace lightcal {

// Nodes of both angles at least `step_deg` > 0 apart, as they stand in the table, from its first
// on; the last of each angle always stays, so that symmetry and range do. Tables as coarse already
// stay as they are.   Refused: bad_table (the nodes that stay are all dark).
[[nodiscard]] Result<IntensityTable> ThinnedTable(const IntensityTable& table, double step_deg);

}  // namespace lightcal
