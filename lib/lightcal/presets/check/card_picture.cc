// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/card_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/uncertain.h"

namespace lightcal {
namespace {

constexpr double kNearTop = 0.998;  // of the top code: saturated

struct PicturePoint {
  double x = 0.0, y = 0.0;
};

// Pixel coordinates, y down, of a point in front of the camera.
std::optional<PicturePoint> Projected(const CheckedRig& rig, const Vec3& point, int width,
                                      int height) {
  const Vec3 view = rig.target_m - rig.camera_m;
  const Vec3 ahead = view * (1.0 / Length(view));
  const Vec3 right = Cross(ahead, rig.up);
  const Vec3 to = point - rig.camera_m;
  const double depth = Dot(to, ahead);
  if (!(depth > 0.0)) return std::nullopt;
  const double focal = height / 2.0 / std::tan(rig.vertical_fov_rad / 2.0);
  return PicturePoint{width / 2.0 + focal * Dot(to, right) / depth,
                      height / 2.0 - focal * Dot(to, rig.up) / depth};
}

bool Inside(const std::array<PicturePoint, 4>& quad, double x, double y) {
  int left = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const PicturePoint& a = quad[i];
    const PicturePoint& b = quad[(i + 1) % 4];
    left += (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0.0 ? 1 : 0;
  }
  return left == 0 || left == 4;
}

// Sample c of a pixel, linear, and the code it came from over the top code.
struct Sampler {
  const Frame& picture;
  std::array<int, 3> channel{0, 1, 2};
  double top = 1.0;

  [[nodiscard]] double Raw(int x, int y, std::size_t c) const {
    return std::visit(
        [&](const auto& view) { return static_cast<double>(view(x, y, channel[c])) / top; },
        picture.samples);
  }
  [[nodiscard]] bool encoded() const { return picture.info.meaning == SampleMeaning::kEncoded; }
  [[nodiscard]] double Linear(double raw) const { return encoded() ? SrgbDecoded(raw) : raw; }
};

Sampler SamplerOf(const Frame& picture) {
  Sampler sampler{picture};
  const auto& names = picture.info.channel_names;
  constexpr std::array<const char*, 3> kNames = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto it = std::ranges::find(names, kNames[c]);
    if (it != names.end()) sampler.channel[c] = static_cast<int>(it - names.begin());
  }
  if (sampler.encoded() && picture.info.levels) sampler.top = picture.info.levels->white[0];
  if (!sampler.encoded()) sampler.top = picture.info.radiance_exposure;
  return sampler;
}

CardPixels MeanOver(const Sampler& sampler, const std::array<PicturePoint, 4>& quad, int width,
                    int height) {
  CardPixels card;
  double low_x = quad[0].x, high_x = quad[0].x, low_y = quad[0].y, high_y = quad[0].y;
  for (const PicturePoint& p : quad) {
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y);
    high_y = std::max(high_y, p.y);
  }
  double count = 0.0, squares = 0.0;
  for (int y = std::max(0, static_cast<int>(low_y)); y < std::min<double>(height, high_y); ++y) {
    for (int x = std::max(0, static_cast<int>(low_x)); x < std::min<double>(width, high_x); ++x) {
      if (!Inside(quad, x + 0.5, y + 0.5)) continue;
      ++count;
      for (std::size_t c = 0; c < 3; ++c) {
        const double raw = sampler.Raw(x, y, c);
        const double linear = sampler.Linear(raw);
        card.raw[c] += raw;
        card.rgb[c] += linear;
        if (c == 1) squares += linear * linear;
      }
    }
  }
  for (std::size_t c = 0; c < 3 && count > 0.0; ++c) {
    card.raw[c] /= count;
    card.rgb[c] /= count;
    if (!sampler.encoded()) continue;
    card.clipped[c] = card.raw[c] > kNearTop;
    card.step[c] = SrgbDecodedSlope(card.raw[c]) / sampler.top;
  }
  if (count > 0.0 && card.rgb[1] > 0.0) {
    const double variance = squares / count - card.rgb[1] * card.rgb[1];
    card.spread = std::sqrt(std::max(0.0, variance)) / card.rgb[1];
    card.noise = kZ95 * card.spread / std::sqrt(count);
  }
  return card;
}

// What a pipeline of another space or white shows, as the lamps gave it: linear Rec. 709 of the
// light itself. Codes are those of a display of Rec. 709 primaries that shows that white as white.
void UndoPipeline(const ColorTarget& pipeline, bool encoded, CardPixels& card) {
  if (!pipeline.white && pipeline.space == RgbSpace::kSrgb) return;
  const RgbSpace space = encoded ? RgbSpace::kSrgb : pipeline.space;
  const Xyz shown = XyzFromLinearRgb({card.rgb[0], card.rgb[1], card.rgb[2]}, space);
  const Rgb own =
      LinearSrgbFromXyz(AdaptBradford(shown, PrimariesOf(space).white, pipeline.SceneWhite()));
  card.rgb = {own.r, own.g, own.b};
}

}  // namespace

Result<std::array<CardPixels, 2>> MeasureCards(const Frame& picture, const CheckedRig& rig) {
  const int width = picture.info.width;
  const int height = picture.info.height;
  if (picture.info.channels < 3) {
    return Refused("not_color", picture.info.file, "has no red, green and blue to measure");
  }
  const Sampler sampler = SamplerOf(picture);
  std::array<CardPixels, 2> cards;
  for (std::size_t i = 0; i < 2; ++i) {
    std::array<PicturePoint, 4> quad;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto place = Projected(rig, rig.cards[i].inner_m[k], width, height);
      if (!place || place->x < 0.0 || place->y < 0.0 || place->x > width || place->y > height) {
        return Refused("cards_outside", picture.info.file,
                       "does not show the whole " + rig.cards[i].name +
                           "; render it through the rig's own camera");
      }
      quad[k] = *place;
    }
    cards[i] = MeanOver(sampler, quad, width, height);
    UndoPipeline(rig.pipeline, sampler.encoded(), cards[i]);
  }
  return cards;
}

}  // namespace lightcal
