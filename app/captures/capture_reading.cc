// SPDX-License-Identifier: Apache-2.0
#include "capture_reading.h"

#include <memory>
#include <utility>
#include <vector>

#include "lamp_luminance.h"
#include "lightcal/calibrate/session_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal_devices/captures/bracket.h"
#include "output_files.h"

namespace lightcal::app {

tl::unexpected<Error> AtCapture(const CaptureDescription& capture, Error error) {
  if (error.code == "no_exposure_metadata") {
    error.message =
        "the frames do not say their exposure; give exposure_s = [..], f_number and iso in the "
        "[[capture]], or anchor_illuminance_lx (" +
        error.message + ")";
  }
  error.subject = capture.where + " (" + error.subject + ")";
  return tl::unexpected(std::move(error));
}

Result<Bracket> OpenCapture(const Session& session, const CaptureDescription& capture) {
  BracketOverrides overrides;
  for (const double time : capture.exposure_s) overrides.exposure.emplace_back(time);
  overrides.f_number = capture.f_number;
  overrides.iso = capture.iso;
  const std::vector<std::string> patterns = {PathInSession(session, capture.frames)};
  auto bracket = OpenBracket(patterns, overrides);
  if (!bracket || capture.work.frame_stride <= 1) return bracket;
  std::vector<FrameInfo> kept;
  const auto stride = static_cast<std::size_t>(capture.work.frame_stride);
  for (std::size_t i = 0; i < bracket->frames.size(); i += stride) {
    kept.push_back(std::move(bracket->frames[i]));
  }
  bracket->frames = std::move(kept);
  return bracket;
}

Result<CameraFile> CameraOfCapture(const Session& session, const CaptureDescription& capture) {
  if (capture.camera.empty()) return CameraFile{};
  const auto text = ReadWholeFile(PathInSession(session, capture.camera));
  if (!text) return tl::unexpected(text.error());
  return CameraFileFromJson(*text, capture.camera);
}

Result<void> UseCameraOfCapture(const Session& session, const CaptureDescription& capture,
                                BracketMergeRequest& request) {
  auto file = CameraOfCapture(session, capture);
  if (!file) return Propagate(std::move(file));
  if (!file->profile) {
    if (capture.nd.empty()) return {};
    return Refused("unknown_nd", capture.nd,
                   capture.camera +
                       " holds spectral sensitivities, which know no filters; give a "
                       "profile made by lightcal camera");
  }
  KnownCamera use;
  use.profile = std::make_shared<const CameraProfile>(std::move(*file->profile));
  use.nd = capture.nd;
  request.camera = std::move(use);
  return {};
}

Result<Region> RegionOfCapture(const CaptureDescription& capture, const FrameInfo& info) {
  Region region{info.width / 3, info.height / 3, info.width / 3, info.height / 3};
  if (capture.rect) {
    const auto& r = *capture.rect;
    region = {r[0], r[1], r[2], r[3]};
  }
  if (auto inside = CheckRegion(region, info.width, info.height); !inside) {
    return Propagate(std::move(inside));
  }
  return region;
}

void NoteCapture(const CaptureDescription& capture, const MergedBracket& merged, Session& session,
                 Warnings& warnings) {
  for (const MergedFrame& frame : merged.frames) NoteInputFile(frame.info.file, session);
  for (const std::string& name : {capture.camera, capture.spectrum_file}) {
    if (!name.empty()) NoteInputFile(PathInSession(session, name), session);
  }
  if (capture.anchor_illuminance || merged.scale_source == ScaleSource::kCamera) return;
  warnings.push_back(
      {"scale_prior", capture.where,
       "its absolute scale is what the ISO speed promises, +-" +
           RoundedText(100.0 * merged.scale_u95_relative, 2) +
           " %; one lux reading of this light, or anchor_illuminance_lx, makes it sure"});
}

Reading ReadingOfPicture(const CaptureDescription& capture, const FrameInfo& info,
                         const MergedBracket& merged, const LampLuminance& lamp) {
  Reading reading;
  reading.light = capture.light;
  reading.xy = lamp.xy;
  reading.color_source = lamp.xy ? ColorSource::kCamera : ColorSource::kUnknown;
  if (lamp.xy) reading.sigma_mired = GenericColorSigma(capture.lamp_class);
  reading.quality = MeterQuality::kDerived;
  reading.device = (merged.scale_source == ScaleSource::kCamera ? kCalibratedDevicePrefix
                                                                : kCameraDevicePrefix) +
                   (info.camera.empty() ? info.format : info.camera);
  reading.time = info.time;
  return reading;
}

double AnchorSigma(const Session& session, const CaptureDescription& capture) {
  Reading anchor;
  anchor.meter = capture.meter;
  return SigmaRelative(session, anchor);
}

}  // namespace lightcal::app
