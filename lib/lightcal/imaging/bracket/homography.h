// SPDX-License-Identifier: Apache-2.0
// How one picture of a plane, or of anything from one place, lies in another.
#pragma once

#include <array>
#include <optional>
#include <utility>

namespace lightcal {

// x' ~ M x in homogeneous coordinates, row by row; the identity to begin with. Places are pixels,
// centres at .5.   Source: Hartley & Zisserman, Multiple View Geometry, 2.3 and 8.4.
struct Homography {
  std::array<double, 9> m{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

  [[nodiscard]] std::pair<double, double> operator()(double x, double y) const {
    const double w = 1.0 / (m[6] * x + m[7] * y + m[8]);
    return {(m[0] * x + m[1] * y + m[2]) * w, (m[3] * x + m[4] * y + m[5]) * w};
  }
  // First `other`, then this.
  [[nodiscard]] Homography After(const Homography& other) const;
  // Absent: it takes areas to lines.
  [[nodiscard]] std::optional<Homography> Inverse() const;
  // Of pictures whose places are q = scale p + (x, y), what this is of p.
  [[nodiscard]] Homography InPlaces(double scale, double x, double y) const;
};

// Root mean square, over a picture of this size, of how far apart two homographies take a place.
[[nodiscard]] double RmsBetween(const Homography& a, const Homography& b, double width,
                                double height);

}  // namespace lightcal
