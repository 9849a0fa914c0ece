// SPDX-License-Identifier: Apache-2.0
// [[camera_frames]] of session.toml. Internal to the records room.
#pragma once

#include "lightcal/records/camera_frames.h"
#include "lightcal/records/field_reader.h"

namespace lightcal::records {

// Refused besides: reflectance_missing (a lux reading that says neither card nor projection).
void ReadCameraFrames(FieldReader& reader, CameraFramesDescription& frames);

}  // namespace lightcal::records
