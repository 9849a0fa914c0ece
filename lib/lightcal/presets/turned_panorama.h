// SPDX-License-Identifier: Apache-2.0
// What a card would get of a panorama that an engine shows the wrong way round.
#pragma once

#include <array>
#include <string_view>

#include "lightcal/core/vec3.h"
#include "lightcal/presets/environment_picture.h"

namespace lightcal {

// Each way takes the picture's directions to others, then turns them round the vertical by any
// angle, from the front to the right. In our axes: front +Y, right +X, up +Z.
struct MistakenTurn {
  std::string_view word;
  std::string_view message;     // what went wrong, and where to set it right
  std::array<Vec3, 3> columns;  // where right, front and up come to stand, before the turn
};
inline constexpr std::size_t kMistakenTurns = 6;
inline constexpr int kTurnSteps = 36;  // of ten degrees

// The first is the picture as it is, turned.
[[nodiscard]] std::array<MistakenTurn, kMistakenTurns> MistakenTurns();

// A white card's linear Rec. 709 in lux: [way][turn in steps of ten degrees].
using TurnedIrradiance = std::array<std::array<Vec3, kTurnSteps>, kMistakenTurns>;
[[nodiscard]] TurnedIrradiance IrradianceIfTurned(const EnvironmentPicture& picture,
                                                  const Vec3& normal);

// The picture that an engine must be given which hangs pictures that way, turned by that much, so
// that it shows this one. Bilinear between pixels; exact where they fall onto one another.
[[nodiscard]] EnvironmentPicture ForEngineThatTurns(const EnvironmentPicture& picture,
                                                    std::size_t way, double turn_deg);

}  // namespace lightcal
