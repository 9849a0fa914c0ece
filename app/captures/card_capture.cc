// SPDX-License-Identifier: Apache-2.0
#include "card_capture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lamp_luminance.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/bracket/thin_frame.h"
#include "lightcal_devices/disk_sources.h"
#include "picture_record.h"

namespace lightcal::app {
namespace {

constexpr double kLargestUnevenness = 0.1;  // sd of the card's pixels beyond their noise, relative
constexpr double kLostSigma = 0.9;          // a pixel's sigma / value where it says nothing
constexpr double kLargestLost = 0.01;       // share of such pixels

// Mean colour of the card in cd/m^2 and how well it is known.
struct CardPatch {
  Xyz color;              // as ColorOfPicture has it
  double noise_sd = 0.0;  // of the mean luminance, relative
  double uneven_sd = 0.0;
};

BracketMergeRequest RequestOf(const CaptureDescription& capture, const Region& card,
                              bool has_colour) {
  BracketMergeRequest request;
  if (has_colour) request.space = RgbSpace::kSrgb;
  request.want_sigma = true;
  request.work = capture.work;
  if (capture.anchor_illuminance) {
    const double nits =
        capture.anchor_illuminance->value() * capture.reflectance / std::numbers::pi;
    request.anchor = SpotReading{card.x, card.y, card.width, card.height, Nits(nits)};
  }
  return request;
}

Result<CardPatch> MeasureCard(const MergedBracket& merged, const Region& card) {
  double sum[3] = {}, luminance = 0.0, luminance2 = 0.0, variance = 0.0;
  int lost = 0;
  for (int y = card.y; y < card.y + card.height; ++y) {
    for (int x = card.x; x < card.x + card.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(merged.width) +
                     static_cast<std::size_t>(x);
      const float* pixel = &merged.picture[i * static_cast<std::size_t>(merged.channels)];
      Rgb rgb{pixel[0], pixel[0], pixel[0]};
      if (merged.channels == 3) rgb = {pixel[0], pixel[1], pixel[2]};
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
  if (patch.uneven_sd > kLargestUnevenness) {
    return Refused("card_uneven", "rect",
                   "what should be the card varies by " + RoundedText(100.0 * patch.uneven_sd, 2) +
                       " %; give its place with rect = [x, y, width, height], inside its edges");
  }
  return patch;
}

}  // namespace

Result<CaptureReading> ReadCard(Session& session, const CaptureDescription& capture,
                                Warnings& warnings) {
  const auto bracket = OpenCapture(session, capture);
  if (!bracket) return AtCapture(capture, bracket.error());
  const FrameInfo& info = bracket->frames.front();
  const auto color = ColorOfPicture(info);
  if (!color) return AtCapture(capture, color.error());
  const auto stated = RegionOfCapture(capture, info);
  if (!stated) return AtCapture(capture, stated.error());
  const Region card = ThinRegion(*stated, ThinningOf(info, capture.work));
  BracketMergeRequest request = RequestOf(capture, card, color->has_colour);
  if (auto used = UseCameraOfCapture(session, capture, request); !used) {
    return AtCapture(capture, used.error());
  }
  if (request.camera && request.camera->profile->color) request.space = RgbSpace::kSrgb;
  const auto merged = MergeBracket(*bracket, DiskSources(), request);
  if (!merged) return AtCapture(capture, merged.error());
  warnings.insert(warnings.end(), merged->warnings.begin(), merged->warnings.end());
  const auto patch = MeasureCard(*merged, card);
  if (!patch) return AtCapture(capture, patch.error());
  const auto corrected = LuminanceOfLamp(session, capture, info, *color, patch->color);
  if (!corrected) return AtCapture(capture, corrected.error());
  NoteCapture(capture, *merged, session, warnings);
  RecordPicture(capture, *merged,
                capture.anchor_illuminance ? 1.0 : corrected->nits / patch->color.Y);

  CaptureReading out;
  out.camera = info.camera;
  out.anchored = capture.anchor_illuminance.has_value();
  out.independent_sd = std::hypot(patch->noise_sd, patch->uneven_sd);
  out.shared_sd = out.anchored ? AnchorSigma(session, capture)
                               : std::hypot(merged->scale_u95_relative / kZ95, corrected->sigma,
                                            capture.reflectance_sigma);
  out.reading = ReadingOfPicture(capture, info, *merged, *corrected);
  Reading& reading = out.reading;
  reading.distance = capture.distance;
  reading.tilt = capture.tilt;
  reading.illuminance = out.anchored
                            ? *capture.anchor_illuminance
                            : Lux(std::numbers::pi * corrected->nits / capture.reflectance);
  return out;
}

}  // namespace lightcal::app
