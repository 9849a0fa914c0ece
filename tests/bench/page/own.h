// SPDX-License-Identifier: Apache-2.0
// lightcal's rows of the figures that are measured inside a process.
#pragma once

#include <vector>

#include "rows.h"

namespace page {

void OwnCct(const std::vector<Numbers>& table);
void OwnArea(const std::vector<Numbers>& table);
void OwnSolver(const std::vector<Numbers>& table);
void OwnIntervals(const std::vector<Numbers>& table);
void OwnMillionDraws(const std::vector<Numbers>& table);

}  // namespace page
