// SPDX-License-Identifier: Apache-2.0
// Fitted lights where they are to stand.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/placed_lamp.h"
#include "lightcal/presets/environment_picture.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// What overrides the lights, by their names: metres; aim and axis of unit length.
struct LampPlaces {
  using ByLight = std::map<std::string, Vec3, std::less<>>;
  ByLight position_m, aim, axis;
};

// The picture of a dome, null where it has none (LoadEnvironment).
using PictureOfDome =
    std::function<Result<std::shared_ptr<const EnvironmentPicture>>(const FittedLight&)>;

// The lights named (none: all), in the file's order.  Refused: unknown_light, no_lights.
[[nodiscard]] Result<std::vector<const FittedLight*>> ChooseLights(
    const LightFile& file, const std::vector<std::string>& names);

// A disk, rect, spot or photometric light without an aim shines straight down (aim_unknown); a spot
// shines as its distribution, else as its cone, and without either evenly, anything less off its
// aim within its doubt (cone_unknown); a flat lamp or tube without a size is a point of its
// kind (size_unknown). A dome sends to every side what its picture shows; without one it is a sky
// that nobody saw. Refused: position_unknown, no_intensity, bad_environment (a picture dark above,
// by which its illuminance is measured), and as `picture`.
[[nodiscard]] Result<std::vector<PlacedLamp>> PlaceLamps(
    const std::vector<const FittedLight*>& lights, const LampPlaces& places,
    const PictureOfDome& picture, Warnings& warnings);

}  // namespace lightcal
