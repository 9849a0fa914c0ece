// SPDX-License-Identifier: Apache-2.0
// The pictures that domes of a light.json name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/environment_picture.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// What a dome's picture is, null where it names none. `folder` is where its light.json lies.
// Refused: bad_environment (no lat-long picture of 2:1, a projection nobody knows), bad_samples and
// others as Sources::read_frame. Fails: not_found.
[[nodiscard]] Result<std::shared_ptr<const EnvironmentPicture>> LoadEnvironment(
    const FittedLight& light, const std::string& folder, const Sources& sources);

// One a light, as LoadEnvironment.
[[nodiscard]] Result<std::vector<std::shared_ptr<const EnvironmentPicture>>> LoadEnvironments(
    const LightFile& lights, const std::string& folder, const Sources& sources);

}  // namespace lightcal
