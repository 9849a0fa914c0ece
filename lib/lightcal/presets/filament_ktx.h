// SPDX-License-Identifier: Apache-2.0
// A panorama as Filament mirrors it: a KTX 1 file as its cmgen makes one. Internal to this room.
#pragma once

#include <string>

#include "lightcal/presets/environment_picture.h"

namespace lightcal {

inline constexpr int kFilamentCubeSide = 128;

// Four levels of a cube map in half floats, sides 128 to 16, in cd/m^2. Level k of n is blurred for
// the perceptual roughness r with r (2 - r) = k/(n - 1), by GGX of alpha = r^2 whose view is along
// its normal, weighed by the cosine: pre-integrated as in Karis, Real Shading in Unreal Engine 4
// (2013). Faces +X -X +Y -Y +Z -Z of glTF's axes, from their upper left, each as Filament's shader
// looks it up. What is brighter than half floats hold is cut. `harmonics`: nine lines "r g b", cmgen's
// metadatum "sh".
// Sources: Khronos, KTX File Format Specification 1; google/filament tools/cmgen, libs/ktxreader,
// libs/ibl CubemapIBL.cpp; rendered in 1.53.4 (tests/engines/render/panorama.py).
[[nodiscard]] std::string FilamentKtx(const EnvironmentPicture& picture,
                                      const std::string& harmonics);

}  // namespace lightcal
