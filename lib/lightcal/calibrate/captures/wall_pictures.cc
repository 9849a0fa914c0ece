// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/wall_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "lightcal/calibrate/captures/capture_reading.h"
#include "lightcal/calibrate/captures/lamp_luminance.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/imaging/scene/flat_top.h"
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

WallSelection SelectionOf(const CaptureDescription& capture, const FrameInfo& info,
                          const Thinning& thinning) {
  WallSelection selection;
  const auto region = [&](const std::array<int, 4>& r) {
    return ThinRegion({r[0], r[1], r[2], r[3]}, thinning);
  };
  if (capture.rect) selection.wall = region(*capture.rect);
  // All that a mask touches: a block more on each side. A shadow's edge is soft.
  const int block = thinning.n == 1 ? 0 : thinning.n * std::max(thinning.columns, thinning.rows);
  const auto leave_out = [&](const std::array<int, 4>& mask, int more) {
    const int x = std::max(0, mask[0] - more), y = std::max(0, mask[1] - more);
    const int right = std::min(std::max(info.width, mask[0] + mask[2]), mask[0] + mask[2] + more);
    const int bottom = std::min(std::max(info.height, mask[1] + mask[3]), mask[1] + mask[3] + more);
    selection.masks.push_back(region({x, y, right - x, bottom - y}));
  };
  for (const auto& mask : capture.wall->masks) leave_out(mask, block);
  for (const auto& shadow : capture.wall->shadows) {
    leave_out(shadow, block + std::max(shadow[2], shadow[3]) / 5);
  }
  selection.board_hangs = capture.wall->board_frame.empty();
  return selection;
}

// Calls `visit` with every pixel that shows the wall, the board included.
template <class Visit>
void ForWall(View2d<const float> picture, const WallSelection& selection, const Visit& visit) {
  const Region all = selection.wall.value_or(Region{0, 0, picture.width(), picture.height()});
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const auto masked = [&](const Region& mask) { return mask.Holds(x, y); };
      if (all.Holds(x, y) && !std::ranges::any_of(selection.masks, masked)) visit(x, y);
    }
  }
}

// Mean of the channels of the wall: the board's paper and ink have no colour.
Column3 MeanOfWall(View2d<const float> rgb, const WallSelection& selection) {
  Column3 sum{};
  double count = 0.0;
  ForWall(rgb, selection, [&](int x, int y) {
    for (int c = 0; c < 3; ++c) {
      sum[static_cast<std::size_t>(c)] += double{rgb(x, y, rgb.channels() == 3 ? c : 0)};
    }
    count += 1.0;
  });
  for (double& channel : sum) channel /= std::max(1.0, count);
  return sum;
}

void WarnOfPlateau(const FrameInfo& info, View2d<const float> samples,
                   const WallSelection& selection, Evidence& evidence) {
  constexpr int kPlateau = 4;
  for (int c = 0; c < samples.channels(); ++c) {
    std::vector<float> wall;
    ForWall(samples, selection, [&](int x, int y) { wall.push_back(samples(x, y, c)); });
    const FlatTop top = TopOf(wall);
    if (!IsCutOff(top, kPlateau)) continue;
    evidence.warnings.push_back(
        {"maybe_clipped", info.file,
         std::to_string(top.at) +
             " pixels of the wall share the picture's largest value; if they are clipped there, "
             "the lamp is brighter than this and its beam narrower: merge a shorter frame too"});
    return;
  }
}

Xyz MeanColor(View2d<const float> rgb, const WallSelection& selection,
              const Matrix3& xyz_from_rgb) {
  const Column3 xyz = Times(xyz_from_rgb, MeanOfWall(rgb, selection));
  return {xyz[0], xyz[1], xyz[2]};
}

// What is no colour of light, of a wall that is dark or masked as a whole, is none.
std::optional<Xyz> LightOrNone(const Xyz& color) {
  return std::min({color.X, color.Y, color.Z}) > 0.0 ? std::optional(color) : std::nullopt;
}

// Of a linear picture; none where it has no colour.
Result<std::optional<Xyz>> ColorOfFrame(const Frame& frame, const WallSelection& selection,
                                        double nits_per_unit) {
  const auto color = ColorOfPicture(frame.info);
  if (!color) return tl::unexpected(color.error());
  const auto* const samples = std::get_if<View2d<const float>>(&frame.samples);
  if (!color->has_colour || samples == nullptr || samples->channels() != 3) return std::nullopt;
  const Xyz mean = MeanColor(*samples, selection, color->xyz_from_rgb);
  return LightOrNone({nits_per_unit * mean.X, nits_per_unit * mean.Y, nits_per_unit * mean.Z});
}

Result<WallPicture> FromAbsolutePicture(const CaptureDescription& capture, const FrameInfo& info,
                                        const Sources& sources, Evidence& evidence) {
  const auto frame = sources.load_frame(info);
  if (!frame) return tl::unexpected(frame.error());
  auto luminance = LuminanceOfPicture(*frame);
  if (!luminance) return Propagate(std::move(luminance));
  WallPicture out;
  out.selection = SelectionOf(capture, info, out.thinning);
  auto color = ColorOfFrame(*frame, out.selection, luminance->nits_per_unit);
  if (!color) return tl::unexpected(color.error());
  evidence.AddWarnings(luminance->warnings);
  if (const auto* const samples = std::get_if<View2d<const float>>(&frame->samples)) {
    WarnOfPlateau(info, *samples, out.selection, evidence);
  }
  evidence.AddFile(info.file);
  out.nits = {luminance->width, luminance->height, std::move(luminance->nits), info.focal_length};
  out.whole_width = info.width;
  out.whole_height = info.height;
  out.scale_sd = StatedScaleSd(info);
  out.color = *color;
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
    if (auto& c = picture->color) c = Xyz{factor * c->X, factor * c->Y, factor * c->Z};
  }
  lit.scale_sd = AnchorSigma(session, capture);
  lit.scale_source = ScaleSource::kAnchor;
  return {};
}

// What the lamp adds to what shines without it, in luminance and colour.
Result<void> Subtract(const WallPicture& off, const CaptureDescription& capture, WallPicture& lit) {
  if (off.nits.width != lit.nits.width || off.nits.height != lit.nits.height) {
    return Refused("mixed_size", capture.wall->off_frames,
                   "the pictures with the lamp off and the frames differ in size; one camera must "
                   "take both, from one place");
  }
  if (lit.color && off.color) {
    lit.color = LightOrNone(
        {lit.color->X - off.color->X, lit.color->Y - off.color->Y, lit.color->Z - off.color->Z});
  }
  for (std::size_t i = 0; i < lit.nits.values.size(); ++i) {
    lit.nits.values[i] -= off.nits.values[i];
    if (i < lit.sigma.size() && i < off.sigma.size()) {
      lit.sigma[i] = std::hypot(lit.sigma[i], off.sigma[i]);
    }
  }
  return {};
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
  WallPicture out;
  out.thinning = picture->thinning;
  out.selection = SelectionOf(capture, picture->info, out.thinning);
  const View2d<const float> rgb(merged.picture.data(), merged.width, merged.height,
                                merged.channels);
  const Xyz seen = MeanColor(rgb, out.selection, XyzFromRgbMatrix(RgbSpace::kSrgb));
  const auto lamp = LuminanceOfLamp(session, capture, *picture, seen, sources);
  if (!lamp) return tl::unexpected(lamp.error());
  AddCapture(session, capture, merged, evidence);
  const double factor = anchor ? 1.0 : lamp->nits / seen.Y;
  const FrameInfo& info = picture->info;
  out.nits = {merged.width, merged.height, LuminanceOf(merged, factor), info.focal_length};
  out.whole_width = info.width;
  out.whole_height = info.height;
  out.sigma = std::move(merged.sigma);
  for (float& sigma : out.sigma) sigma *= static_cast<float>(factor);
  out.scale_sd = std::hypot(merged.scale_u95_relative / kZ95, anchor ? 0.0 : lamp->sigma);
  out.scale_source = merged.scale_source;
  out.flat = merged.corrections.flat().has_value();
  out.shortest_s = ShortestOf(merged);
  if (lamp->xy) {
    const Xyz unit = XyzFromXyAtUnitY(*lamp->xy);
    const double nits = factor * seen.Y;
    out.color = LightOrNone({nits * unit.X, nits, nits * unit.Z});
  }
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
  auto picture = FromAbsolutePicture(capture, first, sources, evidence);
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
