// SPDX-License-Identifier: Apache-2.0
// What each reading of a session says of a lamp's colour. Internal to fit/colour.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/colour/off_wall.h"
#include "lightcal/fit/colour/other_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

struct Estimate2 {
  Vector2 mean = Vector2::Zero();
  Matrix2 covariance = Matrix2::Zero();
};

struct ColorReading {
  Estimate2 in_xy;                // the covariance that the instrument's readings share
  Matrix2 own = Matrix2::Zero();  // and what is this one's alone
  std::pair<std::string, ColorSource> instrument;
  // That with its name, of one that reads a lamp's own light; absent of a camera, of what a box or
  // a data sheet says.
  std::optional<ColorMeter> meter{};
  OtherShares others{};
  bool lit = true;  // else what is left with the lamp off or behind its card
};

// Of all that tell a colour of the lamp; where `others` shine in them, what was read without the
// lamp too, and in place of a reading whose card was read with its colour what the two differ by. A
// reading with other lamps lit counts only where the same place was read without this
// one, and none was read of it alone: X, Y, Z are subtracted. Those of no colour of light are left
// out with the warning color_unusable. `off_wall` (null: none) is one more, its paint's tint undone
// and in doubt.
[[nodiscard]] std::vector<ColorReading> CollectColors(const Session& session,
                                                      const LightDescription& light,
                                                      const OtherLight* others,
                                                      const ColorOffWall* off_wall,
                                                      CctMethod method, Warnings& warnings);

// (mired, Duv) of a chromaticity; false where it has none.
[[nodiscard]] bool MiredDuvOf(const Vector2& xy, CctMethod method, Vector2& out);
[[nodiscard]] Vector2 XyFromMiredDuv(const Vector2& mired_duv);
// The chromaticity xy of light with X/Y times exp(ln_x), Z/Y times exp(ln_z); and, at xy, d(x, y)
// by these two.
[[nodiscard]] Vector2 Tinted(const Vector2& xy, double ln_x, double ln_z);
[[nodiscard]] Matrix2 XyByTint(const Vector2& xy);
[[nodiscard]] Matrix2 CovarianceOf(const SurfaceTint& tint);
// d(x, y)/d(mired, Duv).
[[nodiscard]] Matrix2 XyByMiredDuv(const Vector2& at);

}  // namespace lightcal::fit
