// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/off_wall.h"

#include <cmath>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/srgb_encoding.h"

namespace lightcal::fit {

SurfaceTint TintOfPaint(const std::optional<std::array<int, 3>>& srgb) {
  if (!srgb) return kTintOfPaint;
  constexpr double kCodes = 255.0;
  const auto linear = [&](std::size_t i) { return SrgbDecoded((*srgb)[i] / kCodes); };
  const Xyz paint = XyzFromLinearRgb({linear(0), linear(1), linear(2)}, RgbSpace::kSrgb);
  const Xyz white = XyzFromLinearRgb({1.0, 1.0, 1.0}, RgbSpace::kSrgb);
  return {std::log(paint.X / paint.Y * white.Y / white.X), kToldPaintSdX,
          std::log(paint.Z / paint.Y * white.Y / white.Z), kToldPaintSdZ, 0.0};
}

}  // namespace lightcal::fit
