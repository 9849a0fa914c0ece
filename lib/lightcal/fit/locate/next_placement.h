// SPDX-License-Identifier: Apache-2.0
// Where one more reading tells most about a lamp's position.
#pragma once

#include <optional>
#include <span>

#include "lightcal/fit/locate/placed_solve.h"

namespace lightcal::fit {

// The solver's units: position in metres = origin + length_m x, illuminance in lux = lux x.
struct PlacedFrame {
  Vec3 origin{};
  double length_m = 1.0;
  double lux = 1.0;
};

struct Placement {
  Vec3 position{};             // metres
  std::optional<Vec3> normal;  // absent: facing the lamp
  double lamp_u95_m = 0.0;     // about what the lamp's position would be known to, with it
};

// The best of a grid over the layout's own extent (in its plane where all meters lie in one, with
// their normal), in whole centimetres (millimetres for layouts below a metre): least geometric mean
// of the position's standard deviation over `solutions`, all of which the readings so far allow,
// among the places whose reading tells each solution from the first by five sigma (`separate`), no
// lower than z = 0 or the lowest reading, and where none stands. Nothing when no place of the grid
// sees the lamp.
[[nodiscard]] std::optional<Placement> BestPlacement(const PlacedEstimation& estimation,
                                                     std::span<const PlacedTheta> solutions,
                                                     bool separate, const PlacedFrame& frame);

}  // namespace lightcal::fit
