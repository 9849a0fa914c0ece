// SPDX-License-Identifier: Apache-2.0
// A light's readings as figures and tables show them.
#pragma once

#include <string>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal::report {

// The rows that can stand on a distance axis, in order.
[[nodiscard]] std::vector<ResidualRow> RowsWithDistance(const FittedLight& light);

// "reading 0: 0.5 m, 3 221 lx, +1.00 %"; numbered as in `rejected` and session.toml, from 0.
[[nodiscard]] std::string TooltipOf(const ResidualRow& row);

}  // namespace lightcal::report
