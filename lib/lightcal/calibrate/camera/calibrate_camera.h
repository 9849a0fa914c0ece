// SPDX-License-Identifier: Apache-2.0
// The [[camera_frames]] of a session -> a camera's profile.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/records/camera_profile.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// Dark frames first, then noise, flat fields, colours, filters and the scale, each with what stands
// before it. Files read are added to session.input_files; provenance is left empty.
// Refused: no_camera_frames (nothing to calibrate from), camera_needs_raw, other_camera (frames of
// two cameras), mixed_dark, mixed_aperture, flat_saturated, noise_unseen, duplicate_name,
// two_colour_sources; and as MeasureDark, FitFlatField, ColorFromChart, AddOwnColor, ReadScale,
// CombineScaleReadings, MergeBracket. `warnings` come even where it is refused: they may say why.
[[nodiscard]] Result<CameraProfile> CalibrateCamera(Session& session, const Sources& sources,
                                                    Warnings& warnings);

}  // namespace lightcal
