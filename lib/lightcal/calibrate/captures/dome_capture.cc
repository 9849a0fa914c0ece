// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/dome_capture.h"

#include <algorithm>
#include <utility>

#include "lightcal/calibrate/dome/read_dome.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal {
namespace {

Result<DomeRequest> RequestOf(const Session& session, const CaptureDescription& capture,
                              const Sources& sources) {
  const std::vector<std::string> patterns = {PathInSession(session, capture.frames)};
  auto files = sources.expand_files(patterns);
  if (!files) return Propagate(std::move(files));
  if (files->size() != 1) {
    return Refused("several_pictures", capture.frames,
                   "a dome is one panorama; merge its bracket ({MergeBracket}), or compose views "
                   "({MakeDome}), and name the result");
  }
  DomeRequest request;
  request.input.files = std::move(*files);
  request.input.projection = capture.projection.value_or(Projection::kLatLong);
  request.input.field_of_view = capture.field_of_view.value_or(Radians(0.0));
  if (capture.anchor_illuminance) {
    request.reading = DomeReading{.illuminance = *capture.anchor_illuminance,
                                  .sigma_relative = AnchorSigma(session, capture),
                                  .shaded = std::nullopt};
  }
  return request;
}

}  // namespace

Result<CaptureReading> ReadDomeCapture(const Session& session, const CaptureDescription& capture,
                                       const Sources& sources, Evidence& evidence) {
  const LightDescription* const light = FindLight(session, capture.light);
  if (light == nullptr || light->kind != LightKind::kDome) {
    return Refused("not_a_dome", capture.light,
                   "use = \"dome\" measures all that surrounds the scene: its light is one of "
                   "kind = \"dome\"");
  }
  const auto request = RequestOf(session, capture, sources);
  if (!request) return tl::unexpected(request.error());
  const auto measured = MeasureDome(*request, sources);
  if (!measured) return tl::unexpected(measured.error());
  const DomeInput& input = measured->input;
  if (!capture.anchor_illuminance && !input.absolute) {
    return Refused("no_scale", input.files.front(),
                   "nobody knows this picture's unit; give anchor_illuminance_lx, read where it "
                   "was taken, lying flat");
  }
  evidence.AddWarnings(measured->warnings);
  evidence.AddFile(input.files.front());
  evidence.pictures.push_back(RecordedOf(capture, input.dome.luminance()));

  CaptureReading out;
  out.anchored = capture.anchor_illuminance.has_value();
  const double stated = input.scale_u95_relative.value_or(kUnstatedScaleU95) / kZ95;
  out.shared_sd = out.anchored ? AnchorSigma(session, capture) : stated;
  Reading& reading = out.reading;
  reading.light = capture.light;
  reading.illuminance = capture.anchor_illuminance.value_or(
      IlluminanceOn(input.dome.luminance(), input.dome.grid(), {0.0, 0.0, 1.0}));
  reading.xy = XyFromAbove(input.dome);
  if (reading.xy) {
    reading.color_source = ColorSource::kCamera;
    reading.sigma_mired = GenericColorSigma(ClassOfLamp(session, capture.light));
  }
  reading.quality = MeterQuality::kDerived;
  reading.device = "panorama";
  return out;
}

}  // namespace lightcal
