// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/rendered_color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/rgb_spaces.h"

namespace lightcal {
namespace {

using Rgb3 = std::array<double, 3>;

constexpr double kRounded_uv = 0.002;

std::optional<Uv1976> UvOf(const Rgb3& rgb) {
  const Xyz xyz = XyzFromLinearRgb({rgb[0], rgb[1], rgb[2]}, RgbSpace::kSrgb);
  return xyz.Y > 0.0 ? std::optional(Uv1976FromXy(XyFromXyz(xyz))) : std::nullopt;
}

double ApartBy(const Uv1976& a, const Uv1976& b) { return std::hypot(a.u - b.u, a.v - b.v); }

// What the picture leaves open of a colour, each channel by itself.
double UnsureOfPicture(const std::array<CardPixels, 2>& cards, const Rgb3& rgb, const Uv1976& at) {
  double squares = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const CardPixels& card = cards[cards[0].clipped[c] ? 1 : 0];
    Rgb3 moved = rgb;
    moved[c] *= 1.0 + UnsureOfCard(card, c);
    const auto there = UvOf(moved);
    if (there) squares += ApartBy(*there, at) * ApartBy(*there, at);
  }
  return std::sqrt(squares);
}

double ShareIn(const CheckedRig& rig, std::size_t lamp) {
  return rig.lamps.size() == 1 ? 1.0 : rig.lamp_shares[lamp];
}

}  // namespace

double UnsureOfCard(const CardPixels& card, std::size_t channel) {
  if (!(card.rgb[channel] > 0.0)) return 0.0;
  return std::max(card.noise, card.step[channel] / 2.0 / card.rgb[channel]);
}

std::optional<Rgb3> LightOfLamps(const CheckedRig& rig, std::optional<std::size_t> but) {
  if (rig.lamps.size() > 1 && rig.lamp_shares.size() != rig.lamps.size()) return std::nullopt;
  Rgb3 sum{};
  for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
    const CheckedLamp& lamp = rig.lamps[k];
    if (but == k || !(lamp.color_luminance > 0.0)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += ShareIn(rig, k) * lamp.color[c] / lamp.color_luminance;
    }
  }
  return sum;
}

std::optional<RenderedColor> ColorOfCards(const CheckedRig& rig,
                                          const std::array<CardPixels, 2>& cards, const Rgb3& rgb) {
  if (rig.panorama) return std::nullopt;
  const auto light = LightOfLamps(rig, std::nullopt);
  const auto want = light ? UvOf(*light) : std::nullopt;
  const auto seen = UvOf(rgb);
  if (!want || !seen) return std::nullopt;
  RenderedColor color{ApartBy(*seen, *want), kRounded_uv + UnsureOfPicture(cards, rgb, *seen)};
  for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
    color.allowed_uv += ShareIn(rig, k) * rig.lamps[k].color_u95_uv;
  }
  return color;
}

}  // namespace lightcal
