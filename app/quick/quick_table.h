// SPDX-License-Identifier: Apache-2.0
// Many lamps typed into a table, one a row: the same answers as one by one.
#pragma once

#include "console.h"
#include "lightcal/core/result.h"
#include "quick/quick_session.h"

namespace lightcal::app {

// Columns by their names (or `columns`): name, reading ("203lx@0.5m,card=5lx"), distance_m with
// illuminance_lx and what belongs to it (card_lx, off_lx, angle_deg), several times for several
// readings; cct_K, fixture, kind, room, meter. Units stand in the names: distance_ft,
// illuminance_fc. What a row leaves empty is as the options say. Prints the answers as a table; an
// output that ends in .csv takes them as CSV. A row that is refused is named, the others answer.
// Refused: bad_table, and as the first row that was. Fails: not_found, exists.
[[nodiscard]] Result<void> RunQuickTable(const QuickOptions& options, Console& console);

}  // namespace lightcal::app
