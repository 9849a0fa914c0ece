// SPDX-License-Identifier: Apache-2.0
// The keys of one [[capture]]. Internal to the records room.
#pragma once

#include "lightcal/records/capture.h"
#include "lightcal/records/field_reader.h"

namespace lightcal::records {

// Reads every key of a capture and checks that they agree with one another and with its `use`.
void ReadCapture(FieldReader& reader, CaptureDescription& capture);

// rect = [x, y, width, height] in pixels; also of [[camera_frames]].
void ReadRect(FieldReader& reader, std::optional<std::array<int, 4>>& out);

}  // namespace lightcal::records
