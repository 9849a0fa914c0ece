// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/gamut.h"

#include <algorithm>

namespace lightcal {

Rgb FitToGamut(const Rgb& color, RgbSpace space, GamutPolicy policy) {
  if (policy == GamutPolicy::kKeep || IsInGamut(color)) return color;
  if (policy == GamutPolicy::kClip) {
    return {std::max(color.r, 0.0), std::max(color.g, 0.0), std::max(color.b, 0.0)};
  }
  const double luminance = LuminanceOfRgb(color, space);
  const double least = std::min({color.r, color.g, color.b});
  const double share = least / (least - luminance);
  // The least component is 0 but for rounding; say so.
  const auto mixed = [&](double c) { return std::max(0.0, c + share * (luminance - c)); };
  return {mixed(color.r), mixed(color.g), mixed(color.b)};
}

}  // namespace lightcal
