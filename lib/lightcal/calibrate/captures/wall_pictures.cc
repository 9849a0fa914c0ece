// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/wall_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <variant>

#include "lightcal/calibrate/captures/capture_reading.h"
#include "lightcal/calibrate/captures/lamp_luminance.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal {
namespace {

constexpr double kPictureScaleSd = 0.05;  // of a picture in cd/m^2 that does not say
constexpr const char* kScaleAttribute = "scale_u95_relative";

template <class Sample>
std::vector<float> MeanOfChannels(const View2d<const Sample>& samples) {
  std::vector<float> out;
  for (int y = 0; y < samples.height(); ++y) {
    for (int x = 0; x < samples.width(); ++x) {
      float sum = 0.0F;
      for (int c = 0; c < samples.channels(); ++c) sum += static_cast<float>(samples(x, y, c));
      out.push_back(sum);
    }
  }
  return out;
}

// Rows or columns weighted 1 2 1, edges repeated.
void Smooth(std::vector<float>& values, int width, int height, int dx, int dy) {
  const std::vector<float> from = values;
  const auto at = [&](int x, int y) {
    return from[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width +
                static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      values[static_cast<std::size_t>(y) * width + x] =
          0.25F * at(x - dx, y - dy) + 0.5F * at(x, y) + 0.25F * at(x + dx, y + dy);
    }
  }
}

Region AnchorRegion(const CaptureDescription& capture) {
  const auto& r = *capture.wall->anchor_rect;
  return {r[0], r[1], r[2], r[3]};
}

double StatedScaleSd(const FrameInfo& info) {
  for (const auto& [name, value] : info.lightcal_attributes) {
    if (name != kScaleAttribute) continue;
    const auto u95 = ParseNumber(value);
    if (u95 && *u95 >= 0.0) return *u95 / kZ95;
  }
  return kPictureScaleSd;
}

Result<WallPicture> FromAbsolutePicture(const FrameInfo& info, const Sources& sources,
                                        Evidence& evidence) {
  const auto frame = sources.load_frame(info);
  if (!frame) return tl::unexpected(frame.error());
  auto luminance = LuminanceOfPicture(*frame);
  if (!luminance) return Propagate(std::move(luminance));
  evidence.AddWarnings(luminance->warnings);
  evidence.AddFile(info.file);
  WallPicture out;
  out.nits = {luminance->width, luminance->height, std::move(luminance->nits), info.focal_length};
  out.whole_width = info.width;
  out.whole_height = info.height;
  out.scale_sd = StatedScaleSd(info);
  out.camera = info.camera;
  out.time = info.time;
  return out;
}

// The pictures, of one scale, times what makes the first one the meter's luminance at its place.
Result<void> ScaleByAnchor(const Session& session, const CaptureDescription& capture,
                           WallPicture& lit, WallPicture* off) {
  const auto spot = MeasureRegion(lit.nits.view(), AnchorRegion(capture));
  if (!spot) return tl::unexpected(spot.error());
  if (!(spot->mean.value() > 0.0)) {
    return Refused("bad_anchor", "wall.anchor_rect", "is dark; give the place the meter read");
  }
  const auto factor = static_cast<float>(AnchorLuminance(capture) / spot->mean);
  for (WallPicture* picture : {&lit, off}) {
    if (picture == nullptr) continue;
    for (float& value : picture->nits.values) value *= factor;
    for (float& sigma : picture->sigma) sigma *= factor;
  }
  lit.scale_sd = AnchorSigma(session, capture);
  lit.scale_source = ScaleSource::kAnchor;
  return {};
}

double MeanOf(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += double{value};
  return sum / static_cast<double>(values.size());
}

// What the lamp adds to what shines without it, in luminance and colour.
Result<void> Subtract(const WallPicture& off, const CaptureDescription& capture, WallPicture& lit) {
  if (off.nits.width != lit.nits.width || off.nits.height != lit.nits.height) {
    return Refused("mixed_size", capture.wall->off_frames,
                   "the pictures with the lamp off and the frames differ in size; one camera must "
                   "take both, from one place");
  }
  if (lit.xy && off.xy) {
    const double whole = MeanOf(lit.nits.values) / lit.xy->y;
    const double rest = MeanOf(off.nits.values) / off.xy->y;
    const double y = whole * lit.xy->y - rest * off.xy->y;
    if (y > 0.0 && whole > rest) {
      lit.xy = Xy{(whole * lit.xy->x - rest * off.xy->x) / (whole - rest), y / (whole - rest)};
    }
  }
  for (std::size_t i = 0; i < lit.nits.values.size(); ++i) {
    lit.nits.values[i] -= off.nits.values[i];
    if (i < lit.sigma.size() && i < off.sigma.size()) {
      lit.sigma[i] = std::hypot(lit.sigma[i], off.sigma[i]);
    }
  }
  return {};
}

// Mean of what the frames show, as the lamp's colour: the wall is taken to be neutral.
Xyz MeanColor(const MergedBracket& merged) {
  Xyz sum{};
  const std::size_t pixels = merged.picture.size() / static_cast<std::size_t>(merged.channels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const Xyz xyz = XyzFromLinearRgb(RgbAt(merged, i), RgbSpace::kSrgb);
    sum = {sum.X + xyz.X, sum.Y + xyz.Y, sum.Z + xyz.Z};
  }
  const auto count = static_cast<double>(pixels);
  return {sum.X / count, sum.Y / count, sum.Z / count};
}

Result<WallPicture> FromBracket(const Session& session, const CaptureDescription& capture,
                                const Bracket& bracket, const Sources& sources,
                                Evidence& evidence) {
  std::optional<SpotReading> anchor;
  if (capture.anchor_illuminance) {
    const Region spot =
        ThinRegion(AnchorRegion(capture), ThinningOf(bracket.frames.front(), capture.work));
    anchor = SpotReading{spot.x,
                         spot.y,
                         spot.width,
                         spot.height,
                         AnchorLuminance(capture),
                         AnchorSigma(session, capture)};
  }
  auto picture = MergeCapture(session, capture, bracket, anchor, sources);
  if (!picture) return Propagate(std::move(picture));
  MergedBracket& merged = picture->merged;
  evidence.AddWarnings(merged.warnings);
  const Xyz seen = MeanColor(merged);
  const auto lamp = LuminanceOfLamp(session, capture, *picture, seen, sources);
  if (!lamp) return tl::unexpected(lamp.error());
  AddCapture(session, capture, merged, evidence);
  const double factor = anchor ? 1.0 : lamp->nits / seen.Y;
  const FrameInfo& info = picture->info;
  WallPicture out;
  out.nits = {merged.width, merged.height, LuminanceOf(merged, factor), info.focal_length};
  out.thinning = picture->thinning;
  out.whole_width = info.width;
  out.whole_height = info.height;
  out.sigma = std::move(merged.sigma);
  for (float& sigma : out.sigma) sigma *= static_cast<float>(factor);
  out.scale_sd = std::hypot(merged.scale_u95_relative / kZ95, anchor ? 0.0 : lamp->sigma);
  out.scale_source = merged.scale_source;
  out.flat = merged.corrections.flat().has_value();
  out.xy = lamp->xy;
  out.camera = info.camera;
  out.time = info.time;
  return out;
}

// One linear picture in cd/m^2 as it is, its scale its own; everything else merged as a bracket,
// with the anchor's scale.
Result<WallPicture> ReadPicture(const Session& session, const CaptureDescription& capture,
                                const Sources& sources, Evidence& evidence) {
  const auto bracket = OpenCapture(session, capture, sources);
  if (!bracket) return tl::unexpected(bracket.error());
  const FrameInfo& first = bracket->frames.front();
  const bool absolute = bracket->frames.size() == 1 && first.meaning == SampleMeaning::kLinear &&
                        first.white_luminance.has_value();
  // In cd/m^2 already: how long it was exposed does not matter.
  if (!absolute) return FromBracket(session, capture, *bracket, sources, evidence);
  auto picture = FromAbsolutePicture(first, sources, evidence);
  if (!picture || !capture.anchor_illuminance) return picture;
  if (auto scaled = ScaleByAnchor(session, capture, *picture, nullptr); !scaled) {
    return Propagate(std::move(scaled));
  }
  return picture;
}

}  // namespace

Result<GreyPicture> ReadGrey(const Sources& sources, const std::string& path) {
  const auto frame = sources.read_frame(path);
  if (!frame) return tl::unexpected(frame.error());
  GreyPicture out{frame->info.width, frame->info.height, {}, frame->info.focal_length};
  out.values =
      std::visit([](const auto& samples) { return MeanOfChannels(samples); }, frame->samples);
  if (frame->info.meaning == SampleMeaning::kMosaic) {
    Smooth(out.values, out.width, out.height, 1, 0);
    Smooth(out.values, out.width, out.height, 0, 1);
  }
  return out;
}

Result<WallPicture> ReadWallPicture(const Session& session, const CaptureDescription& capture,
                                    const Sources& sources, Evidence& evidence) {
  if (capture.wall->off_frames.empty()) return ReadPicture(session, capture, sources, evidence);
  CaptureDescription one = capture;  // both in the camera's own scale
  one.anchor_illuminance.reset();
  auto lit = ReadPicture(session, one, sources, evidence);
  if (!lit) return lit;
  one.frames = capture.wall->off_frames;
  one.exposure_s.clear();
  auto off = ReadPicture(session, one, sources, evidence);
  if (!off) return off;
  if (capture.anchor_illuminance) {
    if (auto scaled = ScaleByAnchor(session, capture, *lit, &*off); !scaled) {
      return Propagate(std::move(scaled));
    }
  }
  if (auto subtracted = Subtract(*off, capture, *lit); !subtracted) {
    return Propagate(std::move(subtracted));
  }
  return lit;
}

}  // namespace lightcal
