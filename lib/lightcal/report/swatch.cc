// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/swatch.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/srgb_encoding.h"

namespace lightcal::report {
namespace {

// Two hex digits.
std::string EncodedHex(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const auto code = static_cast<unsigned int>(std::lround(SrgbEncoded(c) * 255.0));
  constexpr std::string_view kHex = "0123456789abcdef";
  return {kHex[code >> 4U], kHex[code & 0xFU]};
}

}  // namespace

std::string HexOf(const Rgb& linear) {
  return "#" + EncodedHex(linear.r) + EncodedHex(linear.g) + EncodedHex(linear.b);
}

std::string SwatchOf(Xy xy) {
  Rgb c = LinearRgbFromXyz(XyzFromXyAtUnitY(xy), RgbSpace::kSrgb);
  const double lift = std::max(0.0, -std::min({c.r, c.g, c.b}));
  c = {c.r + lift, c.g + lift, c.b + lift};
  const double largest = std::max({c.r, c.g, c.b});
  return HexOf({c.r / largest, c.g / largest, c.b / largest});
}

std::string SwatchOf(const FittedColor& color) {
  std::optional<Xy> xy = color.xy;
  if (!xy && color.cct_K && color.cct_K->value > 0.0) {
    xy = XyFromCct(Kelvin(color.cct_K->value), color.duv ? color.duv->value : 0.0);
  }
  return xy && xy->y > 0.0 ? SwatchOf(*xy) : std::string();
}

}  // namespace lightcal::report
