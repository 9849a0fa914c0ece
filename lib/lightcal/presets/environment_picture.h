// SPDX-License-Identifier: Apache-2.0
// The picture of a measured dome, as engines are given it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/core/view2d.h"

namespace lightcal {

// Lat-long, row after row from the upper left: the middle looks along +Y, the right side is +X, the
// upper edge +Z (right-handed, metres, Z up, as everywhere).
struct EnvironmentPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  // linear Rec. 709 whose luminance is cd/m^2; may be negative
  int small_width = 0, small_height = 0;
  std::vector<double> small;  // the same, means over solid angle of at most kSmallWidth columns

  // Makes `small`.
  void Reduce();
};
inline constexpr int kSmallWidth = 512;

// What it shows in a direction of our axes: bilinear between pixels, across the seam. Of `small`,
// or of the whole picture.
[[nodiscard]] std::array<double, 3> RadianceTowards(const EnvironmentPicture& picture,
                                                    const Vec3& direction);
[[nodiscard]] std::array<double, 3> SmallRadianceTowards(const EnvironmentPicture& picture,
                                                         const Vec3& direction);

// On a plane of unit normal n in the middle, per channel: the integral of L max(0, n . w) dOmega.
[[nodiscard]] Vec3 IrradianceOn(const EnvironmentPicture& picture, const Vec3& normal);
[[nodiscard]] std::vector<Vec3> IrradianceOn(const EnvironmentPicture& picture,
                                             std::span<const Vec3> normals);

// Of its radiance, in the basis 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2 (normalised on the
// sphere) of an engine's axes, to which `turn` takes ours. Irradiance has them times pi, 2 pi/3 and
// pi/4.   Source: Ramamoorthi and Hanrahan 2001.
using Harmonics = std::array<Vec3, 9>;
[[nodiscard]] Harmonics RadianceHarmonics(const EnvironmentPicture& picture,
                                          Vec3 (*turn)(const Vec3&));

// What a plane of unit normal n (in the harmonics' axes) gets of them.
[[nodiscard]] Vec3 IrradianceOn(const Harmonics& radiance, const Vec3& normal);

// What nine harmonics make of a picture, on the plane where they stray most from it (of 206 normals
// all round, those the picture lights at all): illuminances [lx] and the normal, in our axes.
struct HarmonicsError {
  Vec3 normal{0.0, 0.0, 1.0};
  double own_lx = 0.0, harmonic_lx = 0.0;

  // Over what the picture gives there.
  [[nodiscard]] double relative() const { return own_lx > 0.0 ? harmonic_lx / own_lx - 1.0 : 0.0; }
};
[[nodiscard]] HarmonicsError WorstOfHarmonics(const EnvironmentPicture& picture);

// The unit vector through the middle of a pixel of a lat-long picture, in our axes.
[[nodiscard]] Vec3 PixelDirection(int x, int y, int width, int height);
// Of a pixel in row y of a lat-long picture [sr].
[[nodiscard]] double PixelSolidAngle(int y, int width, int height);

}  // namespace lightcal
