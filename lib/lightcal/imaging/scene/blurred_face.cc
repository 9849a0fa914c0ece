// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/blurred_face.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal {
namespace {

// The face of that shape which a blur of this variance spreads to the variances seen.
SharpFace FaceUnder(double blur, const BlurredFace& seen, FaceShape shape) {
  if (shape == FaceShape::kRound) {
    const double square = 4.0 * (0.5 * (seen.variance_long + seen.variance_short) - blur);
    const double side = std::sqrt(std::numbers::pi * square);
    const double share = blur > 0.0 ? -std::expm1(-0.5 * square / blur) : 1.0;
    return {side * side, side, side, share};
  }
  const double longer = std::sqrt(12.0 * (seen.variance_long - blur));
  const double shorter = std::sqrt(12.0 * (seen.variance_short - blur));
  const double share = blur > 0.0 ? std::erf(longer / std::sqrt(8.0 * blur)) *
                                        std::erf(shorter / std::sqrt(8.0 * blur))
                                  : 1.0;
  return {longer * shorter, longer, shorter, share};
}

}  // namespace

std::optional<SharpFace> Sharpened(const BlurredFace& seen, FaceShape shape) {
  constexpr int kHalvings = 60;
  constexpr double kAlmostAll = 0.999;  // of the variance: what is left is no face
  // The more of the variance is blur, the smaller the area that it would show.
  const double shows_all = shape == FaceShape::kRound
                               ? 0.5 * (seen.variance_long + seen.variance_short)
                               : std::min(seen.variance_long, seen.variance_short);
  double least = 0.0, most = kAlmostAll * shows_all;
  const auto shown = [&](double blur) {
    const SharpFace face = FaceUnder(blur, seen, shape);
    return face.area / face.share;
  };
  if (!(shows_all > 0.0) || !(shown(most) < seen.area)) return std::nullopt;
  if (shown(least) <= seen.area) most = least;
  for (int i = 0; i < kHalvings && most > least; ++i) {
    const double middle = 0.5 * (least + most);
    (shown(middle) > seen.area ? least : most) = middle;
  }
  SharpFace face = FaceUnder(most, seen, shape);
  // Of the area seen, not of the variances, which a lamp's uneven light moves more.
  const double scale = std::sqrt(seen.area * face.share / face.area);
  face.area *= scale * scale;
  face.longer *= scale;
  face.shorter *= scale;
  return face;
}

}  // namespace lightcal
