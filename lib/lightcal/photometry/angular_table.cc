// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/angular_table.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "lightcal/photometry/solid_angle.h"

namespace lightcal {
namespace {

// int_{-x}^{x} u sin u du = 2 (sin x - x cos x), by its series where the difference cancels.
double OddMoment(double x) {
  if (x > 0.1) return 2.0 * (std::sin(x) - x * std::cos(x));
  const double x2 = x * x;
  return 2.0 * x * x2 * (1.0 / 3.0 - x2 * (1.0 / 30.0 - x2 * (1.0 / 840.0 - x2 / 45360.0)));
}

// Flux of one linear piece: its mean intensity over the zone, and the tilt about the middle angle
// weighted by sin(c + u) = sin c cos u + cos c sin u.
double FluxOfPiece(Radians a, Radians b, Candela at_a, Candela at_b) {
  const double half_step = (b - a).value() / 2.0;
  const double middle = (a + b).value() / 2.0;
  const double mean = (at_a + at_b).value() / 2.0;
  const double slope = (at_b - at_a).value() / (2.0 * half_step);
  return mean * SolidAngleOfZone(a, b).value() +
         2.0 * std::numbers::pi * slope * std::cos(middle) * OddMoment(half_step);
}

tl::unexpected<Error> BadTable(std::size_t row, const std::string& why) {
  return Refused("bad_table", "row " + std::to_string(row + 1), why);
}

Result<void> Check(std::span<const Radians> angles, std::span<const Candela> intensities) {
  if (angles.size() < 2 || angles.size() != intensities.size()) {
    return Refused("bad_table", "intensity table",
                   std::to_string(angles.size()) + " angles and " +
                       std::to_string(intensities.size()) +
                       " intensities; at least two of each are needed, in pairs");
  }
  for (std::size_t i = 0; i < angles.size(); ++i) {
    // Rounding of 180 degrees may pass pi by a bit.
    const double angle = angles[i].value();
    if (!(angle >= 0.0 && angle <= std::numbers::pi * (1.0 + 1e-12))) {
      return BadTable(i, "the angle from the axis must lie within 0 to 180 degrees");
    }
    if (i > 0 && angles[i] <= angles[i - 1]) return BadTable(i, "angles must increase");
    const double intensity = intensities[i].value();
    if (!(intensity >= 0.0) || std::isinf(intensity)) {
      return BadTable(i, "an intensity must be a number of candela, zero or more");
    }
  }
  return {};
}

}  // namespace

Result<Lumens> FluxOfAngularTable(std::span<const Radians> angles,
                                  std::span<const Candela> intensities) {
  if (auto good = Check(angles, intensities); !good) return Propagate(std::move(good));
  double flux = 0.0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    flux += FluxOfPiece(angles[i - 1], angles[i], intensities[i - 1], intensities[i]);
  }
  return Lumens(flux);
}

}  // namespace lightcal
