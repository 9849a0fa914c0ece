// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/capture_reading.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/records/stored_pixels.h"

namespace lightcal {
namespace {

// What capture.camera is, where it is given.
Result<CameraFile> CameraOfCapture(const Session& session, const CaptureDescription& capture,
                                   const Sources& sources) {
  if (capture.camera.empty()) return CameraFile{};
  const auto text = sources.read_text(PathInSession(session, capture.camera));
  if (!text) return tl::unexpected(text.error());
  return CameraFileFromJson(*text, capture.camera);
}

Result<std::optional<KnownCamera>> UseOf(const CameraFile& camera,
                                         const CaptureDescription& capture) {
  if (capture.camera.empty()) return std::nullopt;
  if (!camera.profile) {
    if (capture.nd.empty()) return std::nullopt;
    return Refused("unknown_nd", capture.nd,
                   capture.camera +
                       " holds spectral sensitivities, which know no filters; give a "
                       "profile made by {CalibrateCamera}");
  }
  KnownCamera use;
  use.profile = std::make_shared<const CameraProfile>(*camera.profile);
  use.nd = capture.nd;
  return use;
}

// The first place that a capture tells in pixels of its frames.
std::optional<PixelBox> PlaceToldIn(const CaptureDescription& capture) {
  if (capture.rect) return capture.rect;
  if (capture.ball && capture.ball->rect) return capture.ball->rect;
  if (!capture.wall) return std::nullopt;
  if (capture.wall->anchor_rect) return capture.wall->anchor_rect;
  for (const auto* const boxes : {&capture.wall->masks, &capture.wall->shadows}) {
    if (!boxes->empty()) return boxes->front();
  }
  return std::nullopt;
}

}  // namespace

tl::unexpected<Error> AtCapture(const CaptureDescription& capture, Error error) {
  if (error.code == "no_exposure_metadata") {
    error.message =
        "the frames do not say their exposure; give exposure_s = [..], f_number and iso in the "
        "[[capture]]; of a card or wall anchor_illuminance_lx stands for f_number and iso";
  }
  error.subject = capture.where + " (" + error.subject + ")";
  return tl::unexpected(std::move(error));
}

Result<Bracket> OpenCapture(const Session& session, const CaptureDescription& capture,
                            const Sources& sources) {
  BracketOverrides overrides;
  for (const double time : capture.exposure_s) overrides.exposure.emplace_back(time);
  overrides.f_number = capture.f_number;
  overrides.iso = capture.iso;
  const std::vector<std::string> patterns = {PathInSession(session, capture.frames)};
  auto bracket = sources.open_bracket(patterns, overrides);
  if (!bracket) return bracket;
  if (const auto box = PlaceToldIn(capture)) {
    const auto fits = CheckTurned(capture.where, bracket->frames.front(), *box, bracket->warnings);
    if (!fits) return tl::unexpected(fits.error());
  }
  if (capture.work.frame_stride <= 1) return bracket;
  std::vector<FrameInfo> kept;
  const auto stride = static_cast<std::size_t>(capture.work.frame_stride);
  for (std::size_t i = 0; i < bracket->frames.size(); i += stride) {
    kept.push_back(std::move(bracket->frames[i]));
  }
  bracket->frames = std::move(kept);
  return bracket;
}

Error AtPlace(Error error, const Bracket& bracket, const Warnings& of_merge) {
  const auto shifted = std::ranges::find(of_merge, "misaligned", &Warning::code);
  if (shifted != of_merge.end()) {
    error.message = shifted->subject + ": " + shifted->message +
                    ". A session aligns no frames: take the bracket again from a tripod, or leave "
                    "the shifted frames out. With the frames as they are: " +
                    error.message;
  }
  const auto turned = std::ranges::find(bracket.warnings, "turned_frames", &Warning::code);
  if (turned != bracket.warnings.end()) error.message += "; " + turned->message;
  return error;
}

Result<CapturePicture> MergeCapture(const Session& session, const CaptureDescription& capture,
                                    const Bracket& bracket,
                                    const std::optional<SpotReading>& anchor,
                                    const Sources& sources) {
  const FrameInfo& info = bracket.frames.front();
  if (bracket.frames.size() == 1 && info.white_luminance && !info.exposure.time) {
    return Refused("merged_picture", info.file,
                   "is in cd/m^2 already and no longer says which of its pixels are saturated or "
                   "how sure they are; give the frames that it was merged from");
  }
  auto color = ColorOfPicture(info);
  if (!color) return Propagate(std::move(color));
  auto camera = CameraOfCapture(session, capture, sources);
  if (!camera) return Propagate(std::move(camera));
  auto use = UseOf(*camera, capture);
  if (!use) return Propagate(std::move(use));
  BracketMergeRequest request;
  request.anchor = anchor;
  request.want_sigma = true;
  request.lens_held = true;  // by the session's budget
  request.work = capture.work;
  request.camera = *std::move(use);
  if (!capture.response.empty()) {
    auto response =
        ReadResponse(capture.response, PathInSession(session, capture.response), sources);
    if (!response) return Propagate(std::move(response));
    request.response = *std::move(response);
  }
  const bool profiled = request.camera && request.camera->profile->color;
  if (color->has_colour || profiled) request.space = RgbSpace::kSrgb;
  auto merged = MergeBracket(bracket, sources, request);
  if (!merged) return Propagate(std::move(merged));
  return CapturePicture{info, *std::move(color), *std::move(camera), ThinningOf(info, capture.work),
                        *std::move(merged)};
}

Result<Region> RegionOfCapture(const CaptureDescription& capture, const FrameInfo& info,
                               const Region& otherwise) {
  Region region = otherwise;
  if (capture.rect) {
    const auto& r = *capture.rect;
    region = {r[0], r[1], r[2], r[3]};
  }
  if (auto inside = CheckRegion(region, info.width, info.height); !inside) {
    return Propagate(std::move(inside));
  }
  return region;
}

Nits AnchorLuminance(const CaptureDescription& capture) {
  return Nits(capture.anchor_illuminance->value() * capture.reflectance / std::numbers::pi);
}

namespace {

// What that meter read, for what is known of it.
Reading ReadByMeterOf(const CaptureDescription& capture) {
  Reading anchor;
  anchor.meter = capture.meter;
  return anchor;
}

}  // namespace

SharedScale AnchorScale(const Session& session, const CaptureDescription& capture) {
  return {capture.meter, CalibrationRelative(session, ReadByMeterOf(capture))};
}

double AnchorSigma(const Session& session, const CaptureDescription& capture) {
  return std::hypot(AnchorScale(session, capture).sigma,
                    RepeatabilityRelative(session, ReadByMeterOf(capture)));
}

Rgb RgbAt(const MergedBracket& merged, std::size_t pixel) {
  const float* p = &merged.picture[pixel * static_cast<std::size_t>(merged.channels)];
  return merged.channels == 3 ? Rgb{p[0], p[1], p[2]} : Rgb{p[0], p[0], p[0]};
}

std::vector<float> LuminanceOf(const MergedBracket& merged, double factor) {
  std::vector<float> nits;
  const std::size_t pixels = merged.picture.size() / static_cast<std::size_t>(merged.channels);
  nits.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double value = merged.channels == 3 ? LuminanceOfRgb(RgbAt(merged, i), RgbSpace::kSrgb)
                                              : double{merged.picture[i]};
    nits.push_back(static_cast<float>(factor * value));
  }
  return nits;
}

namespace {

// Whether somebody held a meter to the light.
bool IsMetered(const Session& session, const std::string& light) {
  return std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return row.reading.light == light && row.reading.illuminance && IsLit(row.reading) &&
           row.reading.meter != kDataSheetMeter;
  });
}

// Whether an earlier capture told the same of this light by the same camera.
bool FollowsItsLike(const Session& session, const CaptureDescription& capture) {
  for (const CaptureDescription& earlier : session.captures) {
    if (earlier.where == capture.where) return false;
    if (earlier.light == capture.light && earlier.use == capture.use &&
        earlier.camera == capture.camera && !earlier.anchor_illuminance) {
      return true;
    }
  }
  return false;
}

}  // namespace

void AddCapture(const Session& session, const CaptureDescription& capture,
                const MergedBracket& merged, Evidence& evidence) {
  for (const MergedFrame& frame : merged.frames) evidence.AddFile(frame.info.file);
  for (const std::string& name : {capture.camera, capture.spectrum_file}) {
    if (!name.empty()) evidence.AddFile(PathInSession(session, name));
  }
  if (!capture.response.empty() && !IsResponseWord(capture.response)) {
    evidence.AddFile(PathInSession(session, capture.response));
  }
  if (capture.anchor_illuminance || merged.scale_source == ScaleSource::kCamera) return;
  if (IsMetered(session, capture.light) || FollowsItsLike(session, capture)) return;
  evidence.warnings.push_back(
      {"scale_prior", capture.where,
       "its absolute scale is what the ISO speed promises, +-" +
           RoundedText(100.0 * merged.scale_u95_relative, 2) +
           " %; one lux reading of this light, or anchor_illuminance_lx, makes it sure"});
}

std::optional<double> ShortestOf(const MergedBracket& merged) {
  std::optional<double> shortest;
  for (const MergedFrame& frame : merged.frames) {
    const auto& time = frame.info.exposure.time;
    if (!frame.used || !time) continue;
    shortest = std::min(shortest.value_or(time->value()), time->value());
  }
  return shortest;
}

namespace {

// Exposure of the longest frame whose scale holds so much luminance, in the merge's own unit: most
// of what is read of it is that frame's. The shortest's where none does.
std::optional<double> LongestUnclipped(const MergedBracket& merged, double luminance) {
  constexpr double kUneven = 1.5;  // brightest over mean
  std::optional<double> longest = ShortestOf(merged);
  if (!(luminance > 0.0) || !(merged.nits_per_unit > 0.0)) return longest;
  for (const MergedFrame& frame : merged.frames) {
    const auto& time = frame.info.exposure.time;
    if (!frame.used || !time || !frame.ratio_ev) continue;
    const double part = kUneven * luminance / merged.nits_per_unit * std::exp2(*frame.ratio_ev);
    if (part < 1.0) longest = std::max(longest.value_or(0.0), time->value());
  }
  return longest;
}

PictureFacts FactsOf(const MergedBracket& merged, const PictureFindings& findings) {
  PictureFacts facts;
  facts.flat_field = merged.corrections.flat().has_value();
  const double patch = findings.patch_unit;
  facts.exposure_s = LongestUnclipped(merged, patch);
  facts.off_middle_rad = findings.off_middle_rad;
  // Of a lamp's own light the lens takes its part from the lamp's own picture.
  if (patch > 0.0 && !findings.of_luminance) {
    const std::vector<float> nits = LuminanceOf(merged, 1.0);
    double sum = 0.0;
    for (const float one : nits) sum += double{one};
    facts.mean_over_patch = sum / static_cast<double>(nits.size()) / patch;
  }
  return facts;
}

}  // namespace

CaptureReading ReadingOfPicture(const Session& session, const CaptureDescription& capture,
                                const CapturePicture& picture, const LampLuminance& lamp,
                                const PictureFindings& findings) {
  const FrameInfo& info = picture.info;
  CaptureReading out;
  out.anchored = capture.anchor_illuminance.has_value();
  out.independent_sd = findings.independent_sd;
  out.shared_sd = out.anchored ? AnchorSigma(session, capture)
                               : std::hypot(picture.merged.scale_u95_relative / kZ95, lamp.sigma,
                                            findings.method_sd);
  Reading& reading = out.reading;
  reading.light = capture.light;
  reading.distance = capture.distance;
  reading.illuminance = capture.anchor_illuminance.value_or(findings.illuminance);
  reading.xy = lamp.xy;
  reading.color_source = lamp.xy ? ColorSource::kCamera : ColorSource::kUnknown;
  if (lamp.xy) reading.sigma_mired = GenericColorSigma(ClassOfLamp(session, capture.light));
  reading.quality = MeterQuality::kDerived;
  reading.device = (picture.merged.scale_source == ScaleSource::kCamera ? kCalibratedDevicePrefix
                                                                        : kCameraDevicePrefix) +
                   (info.camera.empty() ? info.format : info.camera);
  reading.time = info.time;
  reading.of_luminance = findings.of_luminance;
  out.found = FactsOf(picture.merged, findings);
  return out;
}

}  // namespace lightcal
