// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/card_capture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "lightcal/calibrate/captures/lamp_luminance.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/light/effects/vignetting.h"

namespace lightcal {
namespace {

constexpr double kLargestCardUnevenness =
    0.1;  // sd of the card's pixels beyond their noise, relative
constexpr double kExplainedBySlope = 0.85, kInwards = 0.7;  // of the scatter; cosine
constexpr double kLostSigma = 0.9;     // a pixel's sigma / value where it says nothing
constexpr double kLargestLost = 0.01;  // share of such pixels

// Mean colour of the card in cd/m^2 and how well it is known.
struct CardPatch {
  Xyz color;              // as ColorOfPicture has it
  double noise_sd = 0.0;  // of the mean luminance, relative
  double uneven_sd = 0.0;
};

// Whether a card grows darker away from the picture's middle, by a slope that explains most of its
// unevenness: the lens does that.
bool DarkensOutwards(const MergedBracket& merged, const Region& card) {
  double sum = 0.0, sum2 = 0.0, across = 0.0, down = 0.0;
  for (int y = 0; y < card.height; ++y) {
    for (int x = 0; x < card.width; ++x) {
      const auto i = static_cast<std::size_t>(card.y + y) * static_cast<std::size_t>(merged.width) +
                     static_cast<std::size_t>(card.x + x);
      const double value = LuminanceOfRgb(RgbAt(merged, i), RgbSpace::kSrgb);
      sum += value;
      sum2 += value * value;
      across += value * (x - 0.5 * (card.width - 1));
      down += value * (y - 0.5 * (card.height - 1));
    }
  }
  const double count = static_cast<double>(card.width) * card.height;
  const double width2 = card.width * card.width - 1.0, height2 = card.height * card.height - 1.0;
  // Least squares: the slopes, and what of the scatter they explain.
  const double slope_x = across / (count * std::max(width2, 1.0) / 12.0);
  const double slope_y = down / (count * std::max(height2, 1.0) / 12.0);
  const double explained = slope_x * across + slope_y * down;
  const double to_x = 0.5 * merged.width - (card.x + 0.5 * card.width);
  const double to_y = 0.5 * merged.height - (card.y + 0.5 * card.height);
  const double inwards = slope_x * to_x + slope_y * to_y;
  return explained > kExplainedBySlope * (sum2 - sum * sum / count) &&
         inwards > kInwards * std::hypot(slope_x, slope_y) * std::hypot(to_x, to_y);
}

Result<CardPatch> MeasureCard(const MergedBracket& merged, const Region& card) {
  double sum[3] = {}, luminance = 0.0, luminance2 = 0.0, variance = 0.0;
  int lost = 0;
  for (int y = card.y; y < card.y + card.height; ++y) {
    for (int x = card.x; x < card.x + card.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(merged.width) +
                     static_cast<std::size_t>(x);
      const Rgb rgb = RgbAt(merged, i);
      sum[0] += rgb.r;
      sum[1] += rgb.g;
      sum[2] += rgb.b;
      const double value = LuminanceOfRgb(rgb, RgbSpace::kSrgb);
      const double sigma = double{merged.sigma[i]};
      luminance += value;
      luminance2 += value * value;
      variance += sigma * sigma;
      if (!(sigma < kLostSigma * value)) ++lost;
    }
  }
  const double count = static_cast<double>(card.width) * card.height;
  if (!(luminance > 0.0) || lost > kLargestLost * count) {
    return Refused("card_unreadable", "rect",
                   "the card is saturated in every frame or lost in the noise; expose shorter or "
                   "longer, or give its place with rect = [x, y, width, height]");
  }
  const double mean = luminance / count;
  const double scatter2 = std::max(0.0, luminance2 / count - mean * mean);
  CardPatch patch;
  patch.color = XyzFromLinearRgb({sum[0] / count, sum[1] / count, sum[2] / count}, RgbSpace::kSrgb);
  patch.noise_sd = kInterpolatedNoise * std::sqrt(variance) / luminance;
  patch.uneven_sd = std::sqrt(std::max(0.0, scatter2 - variance / count)) / mean;
  if (patch.uneven_sd > kLargestCardUnevenness) {
    const std::string cause =
        DarkensOutwards(merged, card)
            ? ". It grows darker away from the picture's middle, as a lens makes it (vignetting): "
              "put the card into the middle, or give camera = a profile with a flat field; else "
              "give its place with rect = [x, y, width, height], inside its edges"
            : "; give its place with rect = [x, y, width, height], inside its edges";
    return Refused("card_uneven", "rect",
                   "what should be the card varies by " + RoundedText(100.0 * patch.uneven_sd, 2) +
                       " %" + cause);
  }
  return patch;
}

// The angle of the card's middle off the lens's axis: by what the file says of its view, else by
// where it stands between the picture's middle and the corner of an ordinary lens.
double OffMiddle(const FrameInfo& info, const Region& card) {
  const double x = card.x + 0.5 * card.width - 0.5 * info.width;
  const double y = card.y + 0.5 * card.height - 0.5 * info.height;
  const double half_width = 0.5 * info.width;
  double focal = std::hypot(half_width, 0.5 * info.height) / std::tan(effects::kCornerDefault_rad);
  if (info.view && info.view->projection == Projection::kRectilinear) {
    focal = half_width / std::tan(0.5 * info.view->field_of_view.value());
  }
  return std::atan(std::hypot(x, y) / focal);
}

}  // namespace

Result<CaptureReading> ReadCard(const Session& session, const CaptureDescription& capture,
                                const Sources& sources, Evidence& evidence) {
  const auto bracket = OpenCapture(session, capture, sources);
  if (!bracket) return tl::unexpected(bracket.error());
  const FrameInfo& info = bracket->frames.front();
  const Region middle{info.width / 3, info.height / 3, info.width / 3, info.height / 3};
  const auto stated = RegionOfCapture(capture, info, middle);
  if (!stated) return tl::unexpected(stated.error());
  const Region card = ThinRegion(*stated, ThinningOf(info, capture.work));
  std::optional<SpotReading> anchor;
  if (capture.anchor_illuminance) {
    anchor = SpotReading{card.x, card.y, card.width, card.height, AnchorLuminance(capture)};
  }
  const auto picture = MergeCapture(session, capture, *bracket, anchor, sources);
  if (!picture) return tl::unexpected(picture.error());
  evidence.AddWarnings(picture->merged.warnings);
  const auto patch = MeasureCard(picture->merged, card);
  if (!patch) return tl::unexpected(AtPlace(patch.error(), *bracket, picture->merged.warnings));
  const auto lamp = LuminanceOfLamp(session, capture, *picture, patch->color, sources);
  if (!lamp) return tl::unexpected(lamp.error());
  AddCapture(session, capture, picture->merged, evidence);
  evidence.pictures.push_back(
      RecordedOf(capture, picture->merged, anchor ? 1.0 : lamp->nits / patch->color.Y));
  CaptureReading out =
      ReadingOfPicture(session, capture, *picture, *lamp,
                       {.illuminance = Lux(std::numbers::pi * lamp->nits / capture.reflectance),
                        .independent_sd = std::hypot(patch->noise_sd, patch->uneven_sd),
                        .method_sd = capture.reflectance_sigma,
                        .patch_unit = patch->color.Y,
                        .off_middle_rad = OffMiddle(info, *stated)});
  out.reading.tilt = capture.tilt;
  return out;
}

}  // namespace lightcal
