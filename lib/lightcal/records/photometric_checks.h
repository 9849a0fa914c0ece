// SPDX-License-Identifier: Apache-2.0
// What of a readable table is probably not as its lamp. Internal to the records room.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/light/intensity_table.h"

namespace lightcal::records {

// no_axis: no intensity is given along the lamp's axis, so that the middle of the beam would be
// dark. LM-63-2002 has type C begin at 0 or 90 and end at 90 or 180 degrees, A and B begin at -90
// or 0; that floodlights' tables end earlier is common, and dark beyond is right.
// open_turn: the planes 0 and 360, one direction, differ by more than 1 % and .2 % of the peak.
void WarnOfGaps(const IntensityGrid& grid, std::string_view where, Warnings& warnings);

}  // namespace lightcal::records
