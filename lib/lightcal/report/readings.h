// SPDX-License-Identifier: Apache-2.0
// A light's readings as figures and tables show them.
#pragma once

#include <string>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal::report {

// The rows that can stand on a distance axis, in order.
[[nodiscard]] std::vector<ResidualRow> RowsWithDistance(const FittedLight& light);

// What the reading would be, turned to the lamp where it shines brightest: measured times facing_lx
// over predicted_lx; as it was read where it was so turned.
[[nodiscard]] double FacingLux(const ResidualRow& row);
// Whether some of them were not.
[[nodiscard]] bool SomeTurned(const std::vector<ResidualRow>& rows);

// Whether some hold light from the walls, which the fit found and figures leave out.
[[nodiscard]] bool HoldWalls(const std::vector<ResidualRow>& rows);

// "reading 0: 0.5 m, 3 221 lx, +1.00 %"; numbered as in `rejected` and session.toml, from 0.
[[nodiscard]] std::string TooltipOf(const ResidualRow& row);

}  // namespace lightcal::report
