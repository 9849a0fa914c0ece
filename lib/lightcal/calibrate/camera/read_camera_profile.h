// SPDX-License-Identifier: Apache-2.0
// The profile of a camera, by the name of its file.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/camera_profile.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// Fails: not_found, unreadable. Refused as CameraFileFromJson; no_profile (sensitivities alone,
// which say nothing of how bright a picture is).
[[nodiscard]] Result<CameraProfile> ReadCameraProfile(const std::string& path,
                                                      const Sources& sources);

}  // namespace lightcal
