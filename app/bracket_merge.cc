// SPDX-License-Identifier: Apache-2.0
#include "bracket_merge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bracket_work.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/bracket/frame_agreement.h"
#include "lightcal/imaging/bracket/merge_picture.h"
#include "lightcal/imaging/bracket/release_rows.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/photometry/exposure.h"
#include "lightcal/photometry/exposure_grid.h"

namespace lightcal::app {
namespace {

// What ISO speeds leave open about a camera's absolute scale (1 sigma): makers choose their
// headroom; published factors of calibrated cameras lie 18 to 24 % above the standard.
constexpr double kIsoPriorSd = 0.2;
// Standard output sensitivity: code 118 of 255 at H = 10/S.   Source: ISO 12232:2006, 6.4.
constexpr double kOutputSensitivityExposure = 10.0;
constexpr double kOutputSensitivityCode = 118.0 / 255.0;
constexpr double kEncodedPriorSd = 0.3;
constexpr double kUsedFrom = 1e-4;  // share of believed samples
constexpr double kClippedSigma = 0.99;

// How much less light focusing near lets onto the sensor.
double FocusOf(const FrameInfo& info) {
  if (!info.focal_length || !info.subject_distance) return 1.0;
  return FocusFactor(*info.focal_length, *info.subject_distance).value_or(1.0);
}

// Signals of the shortest frame per unit of exposure t S/N^2.
double PerExposure(const BracketWork& work) {
  return FocusOf(work.frames[work.planned.order.front()].info) /
         std::exp(work.planned.ln_exposure.front());
}

// Luminance of full scale (signal 1) in the shortest frame, as far as ISO speed tells.
Nits PriorScale(const BracketWork& work) {
  const FrameInfo& info = work.frames[work.planned.order.front()].info;
  const double exposure = std::exp(work.planned.ln_exposure.front());  // t S / N^2
  double nits = SaturatingExposure(1.0).value / (kIsoLensConstant * exposure);
  if (info.meaning == SampleMeaning::kEncoded) {
    const auto& green = work.response.signal_of_code[info.channels == 3 ? kGreenChannel : 0];
    const auto code =
        static_cast<std::size_t>(kOutputSensitivityCode * static_cast<double>(green.size() - 1));
    nits = kOutputSensitivityExposure / (kIsoLensConstant * exposure * double{green[code]});
  } else if (info.meaning != SampleMeaning::kLinear) {
    const bool rgb = info.channels == 3 || info.meaning == SampleMeaning::kMosaic;
    nits /= double{work.signals.front().clip[rgb ? kGreenChannel : 0]};
  }
  return Nits(nits * FocusOf(info));
}

// Row by row product, then a scale.
PictureRows RowsOf(const BracketWork& work, const BracketMergeRequest& request, double scale) {
  const Matrix3& xyz = work.color.xyz_from_rgb;
  PictureRows rows;
  rows.corrections = work.corrections;
  if (request.raw) {
    const bool one = work.signals.front().channels == 1 &&
                     work.frames.front().info.meaning != SampleMeaning::kMosaic;
    rows.picture = {{scale, 0.0, 0.0}, {0.0, scale, 0.0}, {0.0, 0.0, scale}};
    if (one) rows.picture.assign(3, {scale, 0.0, 0.0});
    rows.luminance = rows.picture[1];
    return rows;
  }
  for (std::size_t c = 0; c < 3; ++c) rows.luminance[c] = scale * xyz[1][c];
  if (!request.space) {
    rows.picture = {rows.luminance};
    return rows;
  }
  const Xy target = PrimariesOf(*request.space).white;
  rows.picture.resize(3);
  for (std::size_t c = 0; c < 3; ++c) {
    Xyz color{xyz[0][c], xyz[1][c], xyz[2][c]};
    if (request.white) {
      // X and Z adapt; Y stays, so that a saturated lamp keeps its luminance.
      color = AdaptBradford(color, *request.white, target);
      color.Y = xyz[1][c];
    }
    const Rgb rgb = LinearRgbFromXyz(color, *request.space);
    rows.picture[0][c] = scale * rgb.r;
    rows.picture[1][c] = scale * rgb.g;
    rows.picture[2][c] = scale * rgb.b;
  }
  return rows;
}

bool IsClippedIn(const BracketMerger& merger, const SpotReading& spot) {
  const SignalFrame& frame = merger.frames()[0];
  std::vector<float> value(frame.row_samples());
  std::vector<float> variance(value.size());
  const auto width = static_cast<int>(value.size());
  for (int y = spot.y; y < spot.y + spot.height; ++y) {
    static_cast<void>(merger.MergeRows(y, 1, View2d<float>(value.data(), width, 1),
                                       View2d<float>(variance.data(), width, 1)));
    for (int x = spot.x * frame.channels; x < (spot.x + spot.width) * frame.channels; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const bool bright =
          value[i] > 0.5F * static_cast<float>(merger.plan().usable) * frame.clip[0];
      if (bright && variance[i] > kClippedSigma * value[i] * value[i]) return true;
    }
  }
  return false;
}

struct Scale {
  double nits_per_unit = 0.0, sd_relative = 0.0;
};

// What brings the spot's mean luminance to the reading.
Result<Scale> AnchorScale(const BracketMerger& merger, const PictureRows& rows, double prior,
                          const SpotReading& spot, double ratio_sd) {
  const SignalFrame& frame = merger.frames()[0];
  const std::string where = std::to_string(spot.x) + "," + std::to_string(spot.y) + "," +
                            std::to_string(spot.width) + "," + std::to_string(spot.height);
  if (spot.x < 0 || spot.y < 0 || spot.width < 1 || spot.height < 1 ||
      spot.x + spot.width > frame.width || spot.y + spot.height > frame.height) {
    return Refused("bad_anchor", where,
                   "is not inside the picture of " + std::to_string(frame.width) + " x " +
                       std::to_string(frame.height) + " pixels");
  }
  if (IsClippedIn(merger, spot)) {
    return Refused("bad_anchor", where,
                   "is saturated in every frame; read a darker place, or expose shorter");
  }
  const std::size_t samples =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(spot.height);
  std::vector<float> luminance(samples), sigma(samples);
  const auto done =
      MergePicture(merger, {.picture = {rows.luminance}, .luminance = rows.luminance}, spot.y,
                   spot.height, View2d<float>(luminance.data(), frame.width, spot.height),
                   View2d<float>(sigma.data(), frame.width, spot.height));
  if (!done) return tl::unexpected(done.error());
  double sum = 0.0, variance = 0.0;
  for (int y = 0; y < spot.height; ++y) {
    for (int x = spot.x; x < spot.x + spot.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                     static_cast<std::size_t>(x);
      sum += luminance[i];
      variance += double{sigma[i]} * sigma[i];
    }
  }
  const double sd = kInterpolatedNoise * std::sqrt(variance) / sum;
  if (!(sum > 0.0) || !(sd < 0.5)) {
    return Refused("bad_anchor", where, "is too dark to be measured; read a brighter place");
  }
  const double mean = sum / (static_cast<double>(spot.width) * spot.height);
  return Scale{prior * spot.luminance.value() / mean,
               std::hypot(std::hypot(spot.sigma_relative, sd), ratio_sd)};
}

std::vector<MergedFrame> FramesOf(const BracketWork& work) {
  std::vector<MergedFrame> frames;
  for (const Frame& frame : work.frames) frames.push_back({frame.info, std::nullopt, false});
  const PlannedMerge& planned = work.planned;
  for (std::size_t i = 0; i < planned.order.size(); ++i) {
    MergedFrame& frame = frames[planned.order[i]];
    frame.ratio_ev = std::log2(planned.plan.exposure[i] / planned.plan.exposure[0]);
    frame.used = planned.usable_share[i] > kUsedFrom;
    if (work.alignment) frame.moved = work.alignment->moved[i];
  }
  return frames;
}

// Of the light that the camera balanced for; the middle of the factor's lamps where it does not
// say.
Mireds MiredsOfFrame(const FrameInfo& info, const MismatchFactor& lamp) {
  if (info.matrices && info.as_shot_neutral) {
    if (const auto xy = XyFromCameraNeutral(*info.matrices, *info.as_shot_neutral)) {
      return MiredsOfLamp(*xy);
    }
  }
  return Mireds(lamp.middle_mired);
}

const char* ScaleSourceOf(const BracketMergeRequest& request) {
  if (request.anchor) return "anchor";
  const bool read = request.camera && !request.camera->profile->scale.readings.empty();
  return read ? kCameraScale : "iso_prior";
}

Result<Scale> ScaleOf(const BracketMerger& merger, const BracketWork& work,
                      const BracketMergeRequest& request) {
  if (request.raw) return Scale{PerExposure(work), work.planned.gauge_sd};
  const double prior = PriorScale(work).value();
  if (request.anchor) {
    const double ratio_sd = *std::max_element(work.planned.sd_ln.begin(), work.planned.sd_ln.end());
    SpotReading spot = *request.anchor;
    if (work.alignment) {
      spot.x -= work.alignment->x;
      spot.y -= work.alignment->y;
    }
    return AnchorScale(merger, RowsOf(work, request, prior), prior, spot, ratio_sd);
  }
  const bool encoded = work.frames[0].info.meaning == SampleMeaning::kEncoded;
  const FrameInfo& info = work.frames[work.planned.order.front()].info;
  Scale scale{prior, encoded ? kEncodedPriorSd : kIsoPriorSd};
  if (request.camera && !request.camera->profile->scale.readings.empty()) {
    scale = {request.camera->profile->scale.full_scale_constant * PerExposure(work),
             CameraScaleSigma(*request.camera, info)};
  }
  scale.sd_relative = std::hypot(scale.sd_relative, work.planned.gauge_sd);
  if (request.lamp) {
    scale.nits_per_unit *= request.lamp->At(MiredsOfFrame(info, *request.lamp));
    scale.sd_relative = std::hypot(scale.sd_relative, request.lamp->sigma);
  }
  return scale;
}

// Pixels by which frames may still lie apart: aligned ones keep to whole periods of the pattern.
double Unaligned(const BracketWork& work) {
  if (!work.alignment || !work.alignment->any()) return kLeastShiftPixels;
  const SignalFrame& frame = work.signals.front();
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
                                 const BracketWork& work, View2d<float> picture,
                                 View2d<float> sigma) {
  const bool in_files = std::all_of(work.frames.begin(), work.frames.end(),
                                    [](const Frame& frame) { return frame.in_file; });
  const int height = picture.height(), width = picture.width();
  const int band = in_files && !work.alignment ? BandRows(work.frames) : height;
  std::size_t clipped = 0;
  for (const Frame& frame : work.frames) ReleaseRows(frame, 0, frame.info.height);
  for (int first = 0; first < height; first += band) {
    const int count = std::min(band, height - first);
    const auto done = MergePicture(merger, rows, first, count, picture.Crop(0, first, width, count),
                                   sigma.empty() ? sigma : sigma.Crop(0, first, width, count));
    if (!done) return done;
    clipped += *done;
    if (band == height) continue;
    for (const Frame& frame : work.frames) ReleaseRows(frame, first, count);
  }
  return clipped;
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

Result<MergedBracket> MergeBracket(const Bracket& bracket, const BracketMergeRequest& request) {
  MergedBracket merged;
  merged.warnings = bracket.warnings;
  const auto work = PrepareBracket(request, bracket, merged.warnings);
  if (!work) return tl::unexpected(work.error());
  const auto merger = BracketMerger::Make((*work)->signals, (*work)->planned.plan);
  if (!merger) return tl::unexpected(merger.error());
  const auto let_go = [&](std::size_t k) {
    const Frame& frame = (*work)->frames[(*work)->planned.order[k]];
    ReleaseRows(frame, 0, frame.info.height);
  };
  if (request.work.check_frames) {
    Append(CompareFrames(*merger, Unaligned(**work), let_go), merged.warnings);
  }
  const auto scale = ScaleOf(*merger, **work, request);
  if (!scale) return tl::unexpected(scale.error());

  merged.frames = FramesOf(**work);
  merged.width = merger->frames()[0].width;
  merged.height = merger->frames()[0].height;
  if (const auto& a = (*work)->alignment) merged.crop = Region{a->x, a->y, a->width, a->height};
  merged.channels = request.space || request.raw ? 3 : 1;
  merged.nits_per_unit = scale->nits_per_unit;
  merged.scale_source = ScaleSourceOf(request);
  merged.gauge_sd = (*work)->planned.gauge_sd;
  merged.corrections = (*work)->corrections;
  merged.masked_pixels = (*work)->masked.empty() ? 0 : merged.corrections.hot_pixels();
  merged.scale_u95_relative = kZ95 * scale->sd_relative;
  merged.plan = merger->plan();
  merged.noise_source = (*work)->planned.noise_source;

  const std::size_t pixels =
      static_cast<std::size_t>(merged.width) * static_cast<std::size_t>(merged.height);
  merged.picture.resize(pixels * static_cast<std::size_t>(merged.channels));
  if (request.want_sigma) merged.sigma.resize(pixels);
  const View2d<float> sigma = request.want_sigma
                                  ? View2d<float>(merged.sigma.data(), merged.width, merged.height)
                                  : View2d<float>();
  const auto clipped = MergeInBands(
      *merger, RowsOf(**work, request, merged.nits_per_unit), **work,
      View2d<float>(merged.picture.data(), merged.width, merged.height, merged.channels), sigma);
  if (!clipped) return tl::unexpected(clipped.error());
  merged.clipped_fraction = static_cast<double>(*clipped) /
                            static_cast<double>(merger->frames()[0].row_samples()) / merged.height;
  WarnOfClipping(merged);
  return merged;
}

Result<std::optional<NoiseProfile>> MeasureBracketNoise(const Bracket& bracket,
                                                        const CameraUse& camera) {
  BracketMergeRequest request;
  request.camera = camera;
  request.camera->flat = false;
  request.own_noise = true;
  Warnings ignored;
  const auto work = PrepareBracket(request, bracket, ignored);
  if (!work) return tl::unexpected(work.error());
  const PlannedMerge& planned = (*work)->planned;
  if (planned.noise_source != NoiseSource::kEstimated) return std::nullopt;
  return planned.plan.noise.front();
}

}  // namespace lightcal::app
