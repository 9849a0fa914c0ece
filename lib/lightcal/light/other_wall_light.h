// SPDX-License-Identifier: Apache-2.0
// Light on a wall that is not the lamp's own: what the room throws back, what others shine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace lightcal {

// The wall is the plane y = 0.
//   E(x, z) = lux exp(by_x X + by_z Z + by_r2 (X^2 + Z^2)),  X = (x - foot_x)/distance, Z likewise;
// beyond X^2 + Z^2 = 1 as at 1 in that direction.
struct OtherWallLight {
  double lux = 0.0;
  double by_x = 0.0, by_z = 0.0, by_r2 = 0.0;
  double foot_x_m = 0.0, foot_z_m = 0.0;  // the wall's point nearest to the lamp
  double distance_m = 1.0;                // of the lamp from it

  // X, Z, X^2 + Z^2, held within the unit circle.
  [[nodiscard]] std::array<double, 3> ShapeAt(double x_m, double z_m) const {
    const double x = (x_m - foot_x_m) / distance_m, z = (z_m - foot_z_m) / distance_m;
    const double held = 1.0 / std::max(1.0, std::hypot(x, z));
    return {held * x, held * z, held * held * (x * x + z * z)};
  }
  [[nodiscard]] double At(double x_m, double z_m) const {
    const auto shape = ShapeAt(x_m, z_m);
    return lux * std::exp(by_x * shape[0] + by_z * shape[1] + by_r2 * shape[2]);
  }
};

// A place (x, z) of the wall, all light that it shows, and 1 sigma of that.
struct SeenPlace {
  double x_m = 0.0, z_m = 0.0;
  double lux = 0.0, sigma_lx = 0.0;
};

}  // namespace lightcal
