// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/merge_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/bracket/frame_agreement.h"
#include "lightcal/imaging/bracket/merge_picture.h"
#include "lightcal/imaging/bracket/picture_scale.h"
#include "lightcal/imaging/bracket/prepare_frames.h"
#include "lightcal/imaging/bracket/release_rows.h"
#include "lightcal/light/effects/vignetting.h"

namespace lightcal {
namespace {

constexpr double kFallOffPixels = 2.0;
constexpr double kUsedFrom = 1e-4;  // share of believed samples

std::vector<MergedFrame> FramesOf(const PreparedFrames& prepared) {
  std::vector<MergedFrame> frames;
  for (const Frame& frame : prepared.frames) frames.push_back({frame.info, std::nullopt, false});
  const PlannedMerge& planned = prepared.planned;
  for (std::size_t i = 0; i < planned.order.size(); ++i) {
    MergedFrame& frame = frames[planned.order[i]];
    frame.ratio_ev = std::log2(planned.plan.exposure[i] / planned.plan.exposure[0]);
    frame.used = planned.usable_share[i] > kUsedFrom;
    if (prepared.alignment) frame.moved = prepared.alignment->moved[i];
  }
  return frames;
}

// Pixels by which frames may still lie apart: aligned ones keep to whole periods of the pattern.
double Unaligned(const PreparedFrames& prepared) {
  const auto& alignment = prepared.alignment;
  if (!alignment || !alignment->any()) return kLeastShiftPixels;
  // Found to .3 pixels and checked: what blocks take for a shift is the lens's fall-off, which
  // moved.
  if (alignment->interpolated) return kFallOffPixels;
  const SignalFrame& frame = prepared.signals.front();
  return kLeastShiftPixels + 0.5 * std::hypot(frame.column_period, frame.row_period);
}

// Rows of which all frames together have kBandBytes of samples, in whole periods of any pattern.
int BandRows(std::span<const Frame> frames) {
  constexpr std::size_t kBandBytes = std::size_t{1} << 28;
  std::size_t row_bytes = 0;
  for (const Frame& frame : frames) {
    row_bytes +=
        std::visit([](const auto& view) { return view.row(0).size_bytes(); }, frame.samples);
  }
  const std::size_t periods = kBandBytes / std::max<std::size_t>(row_bytes * kLanes, 1);
  return kLanes * static_cast<int>(std::clamp<std::size_t>(periods, 1, 20));
}

// The whole picture; frames that lie in scratch files are in memory by a band at a time.
Result<std::size_t> MergeInBands(const BracketMerger& merger, const PictureRows& rows,
                                 const PreparedFrames& prepared, View2d<float> picture,
                                 View2d<float> sigma, const Progress& progress) {
  const bool in_files = std::all_of(prepared.frames.begin(), prepared.frames.end(),
                                    [](const Frame& frame) { return frame.in_file; });
  const int height = picture.height(), width = picture.width();
  const int band = in_files && !prepared.alignment ? BandRows(prepared.frames) : height;
  std::size_t clipped = 0;
  for (const Frame& frame : prepared.frames) ReleaseRows(frame, 0, frame.info.height);
  for (int first = 0; first < height; first += band) {
    const int count = std::min(band, height - first);
    const auto done = MergePicture(merger, rows, first, count, picture.Crop(0, first, width, count),
                                   sigma.empty() ? sigma : sigma.Crop(0, first, width, count),
                                   PartOf(progress, static_cast<double>(first) / height,
                                          static_cast<double>(first + count) / height));
    if (!done) return done;
    clipped += *done;
    if (band == height) continue;
    for (const Frame& frame : prepared.frames) ReleaseRows(frame, first, count);
  }
  return clipped;
}

// Of a picture scaled by a camera's profile that does not know its lens.
void WarnOfLens(const FrameInfo& info, const BracketMergeRequest& request, MergedBracket& merged) {
  if (!request.camera || request.raw || request.lens_held || merged.corrections.flat()) return;
  double corner = effects::kCornerDefault_rad;
  if (info.view && info.view->projection == Projection::kRectilinear) {
    corner = std::atan(std::tan(0.5 * info.view->field_of_view.value()) *
                       std::hypot(1.0, static_cast<double>(info.height) / info.width));
  }
  merged.warnings.push_back(
      {"vignetting_unknown", info.file,
       "no flat field takes out what the lens loses towards the corners: about " +
           PercentText(1.0 - std::pow(std::cos(corner), 4)) + " there (cos^4, " +
           RoundedText(DegreesFromRadians(Radians(corner)), 2) +
           " degrees off the axis), more wide open, and sigma does not hold it. Add frames with "
           "use = \"flat\" to the camera's session, or give {merge.cosine_fourth}"});
}

void WarnOfClipping(MergedBracket& merged) {
  if (merged.clipped_fraction <= 0.0) return;
  merged.warnings.push_back(
      {"clipped", merged.frames.front().info.file,
       RoundedText(100.0 * merged.clipped_fraction, 2) +
           " % of the samples are saturated in the shortest frame too: there the picture is a "
           "lower bound and its sigma as large as itself; expose shorter or use an ND filter"});
}

}  // namespace

Result<MergedBracket> MergeFrames(const Bracket& bracket, const FrameLoader& load,
                                  const BracketMergeRequest& request) {
  MergedBracket merged;
  merged.warnings = bracket.warnings;
  const auto prepared = PrepareFrames(request, bracket, load, merged.warnings);
  if (!prepared) return tl::unexpected(prepared.error());
  const auto merger = BracketMerger::Make((*prepared)->signals, (*prepared)->planned.plan);
  if (!merger) return tl::unexpected(merger.error());
  const auto release = [&](std::size_t k) {
    const Frame& frame = (*prepared)->frames[(*prepared)->planned.order[k]];
    ReleaseRows(frame, 0, frame.info.height);
  };
  if (request.work.check_frames) {
    Append(CompareFrames(*merger, Unaligned(**prepared), release), merged.warnings);
  }
  const auto scale = ScaleOf(*merger, **prepared, request);
  if (!scale) return tl::unexpected(scale.error());
  WarnOfAnchor(*scale, bracket.frames.front().file, merged.warnings);

  merged.frames = FramesOf(**prepared);
  merged.width = merger->frames()[0].width;
  merged.height = merger->frames()[0].height;
  if (const auto& a = (*prepared)->alignment) {
    merged.crop = Region{a->x, a->y, a->width, a->height};
    merged.aligned_to = merger->frames()[a->reference].name;
  }
  merged.channels = request.space || request.raw ? 3 : 1;
  merged.nits_per_unit = scale->nits_per_unit;
  merged.scale_source = ScaleSourceOf(request);
  merged.gauge_sd = (*prepared)->planned.gauge_sd;
  merged.corrections = (*prepared)->corrections;
  merged.masked_pixels = (*prepared)->masked.empty() ? 0 : merged.corrections.hot_pixels();
  merged.scale_u95_relative = kZ95 * scale->sd_relative;
  merged.plan = merger->plan();
  merged.noise_source = (*prepared)->planned.noise_source;
  merged.response = (*prepared)->response;
  if (merged.plan.encoded) merged.response_source = request.response ? "stated" : "recovered";

  const std::size_t pixels =
      static_cast<std::size_t>(merged.width) * static_cast<std::size_t>(merged.height);
  merged.picture.resize(pixels * static_cast<std::size_t>(merged.channels));
  if (request.want_sigma) merged.sigma.resize(pixels);
  const View2d<float> sigma = request.want_sigma
                                  ? View2d<float>(merged.sigma.data(), merged.width, merged.height)
                                  : View2d<float>();
  const auto clipped = MergeInBands(
      *merger, RowsOf(**prepared, request, merged.nits_per_unit), **prepared,
      View2d<float>(merged.picture.data(), merged.width, merged.height, merged.channels), sigma,
      PartOf(request.progress, kLoadingShare, 1.0));
  if (!clipped) return tl::unexpected(clipped.error());
  merged.clipped_fraction = static_cast<double>(*clipped) /
                            static_cast<double>(merger->frames()[0].row_samples()) / merged.height;
  WarnOfClipping(merged);
  WarnOfLens(bracket.frames.front(), request, merged);
  return merged;
}

Result<std::optional<NoiseProfile>> MeasureBracketNoise(const Bracket& bracket,
                                                        const FrameLoader& load,
                                                        const KnownCamera& camera) {
  BracketMergeRequest request;
  request.camera = camera;
  request.camera->flat = false;
  request.own_noise = true;
  Warnings ignored;
  const auto prepared = PrepareFrames(request, bracket, load, ignored);
  if (!prepared) return tl::unexpected(prepared.error());
  const PlannedMerge& planned = (*prepared)->planned;
  if (planned.noise_source != NoiseSource::kEstimated) return std::nullopt;
  return planned.plan.noise.front();
}

}  // namespace lightcal
