// SPDX-License-Identifier: Apache-2.0
// The keys of [capture.wall]. Internal to the records room.
#pragma once

#include "lightcal/records/field_reader.h"
#include "lightcal/records/wall_capture.h"

namespace lightcal::records {

void ReadWall(FieldReader& reader, WallDescription& wall);

}  // namespace lightcal::records
