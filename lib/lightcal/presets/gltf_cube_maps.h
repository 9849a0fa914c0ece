// SPDX-License-Identifier: Apache-2.0
// A panorama as EXT_lights_image_based takes its mirror images: cube maps, blurred for each
// roughness, as RGBD in PNG. Internal to this room.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lightcal/presets/environment_picture.h"

namespace lightcal {

// A radiance as RGBD, whose value is rgb/d: at most 255 in the largest component.
[[nodiscard]] std::array<std::uint8_t, 4> RgbdOf(const std::array<double, 3>& radiance);

// +X -X +Y -Y +Z -Z of glTF's axes, from their upper left as OpenGL has them; PNG files.
using CubeMap = std::array<std::string, 6>;

// Where texel (s, t) of a face looks, both 0 to 1 from its upper left.
[[nodiscard]] Vec3 TexelOfCube(int face, double s, double t);

// From a mirror, `side` texels, down to a single texel of a matt sheen. The lobe of a roughness r:
// sharpness 2/r^4, as wide as GGX at r^2.
[[nodiscard]] std::vector<CubeMap> PrefilteredCube(const EnvironmentPicture& picture, int side);

}  // namespace lightcal
