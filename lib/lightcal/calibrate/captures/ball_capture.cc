// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/ball_capture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "lightcal/calibrate/captures/capture_reading.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/scene/highlight.h"
#include "lightcal/imaging/scene/mirror_ball.h"

namespace lightcal {
namespace {

constexpr double kPositionDiffers = 4.0;  // sd

// The mean of the channels in the box, whatever they are: codes, raw values, luminance.
std::vector<float> ValuesIn(const Frame& frame, const Region& box) {
  std::vector<float> values;
  std::visit(
      [&](const auto& samples) {
        for (int y = box.y; y < box.y + box.height; ++y) {
          for (int x = box.x; x < box.x + box.width; ++x) {
            float sum = 0.0F;
            for (int c = 0; c < samples.channels(); ++c) {
              sum += static_cast<float>(samples(x, y, c));
            }
            values.push_back(sum);
          }
        }
      },
      frame.samples);
  return values;
}

Result<BallRay> ReadBall(const Session& session, const CaptureDescription& capture,
                         const Sources& sources, Evidence& evidence) {
  const std::vector<std::string> patterns = {PathInSession(session, capture.frames)};
  const auto files = sources.expand_files(patterns);
  if (!files) return tl::unexpected(files.error());
  if (files->size() != 1) {
    return Refused("several_pictures", capture.frames,
                   "one picture shows a ball; name the one that shows the highlight unclipped");
  }
  const auto frame = sources.read_frame(files->front());
  if (!frame) return tl::unexpected(frame.error());
  evidence.AddFile(files->front());
  const BallDescription& ball = *capture.ball;
  const auto& [x, y, w, h] = *ball.rect;
  const FrameInfo& info = frame->info;
  const Region box{x, y, w, h};
  if (auto inside = CheckRegion(box, info.width, info.height); !inside) {
    return Propagate(std::move(inside));
  }
  auto view =
      PixelSolidAngles::Create({capture.projection.value_or(Projection::kRectilinear), info.width,
                                info.height, capture.field_of_view.value_or(Radians(0.0))});
  if (!view) return Propagate(std::move(view));
  const std::vector<float> values = ValuesIn(*frame, box);
  const auto spot = FindHighlight({values.data(), w, h}, files->front());
  if (!spot) return tl::unexpected(spot.error());
  if (!spot->alone) {
    evidence.warnings.push_back(
        {"several_highlights", capture.where,
         "another spot on the ball is nearly as bright; the brightest is taken: switch other lamps "
         "off to be sure"});
  }
  const BallPicture picture{
      capture.where,
      std::move(*view),
      {ball.camera_position_m, ball.camera_aim.value_or(Vec3{0.0, 1.0, 0.0}), ball.camera_roll},
      ball.diameter,
      {double(x), double(y), double(w), double(h)},
      {x + spot->point[0], y + spot->point[1]}};
  BallErrors errors;
  errors.camera_m = kSigmaCameraPosition;
  errors.aim_rad = RadiansFromDegrees(kSigmaCameraAimDegrees).value();
  return RayOfBall(picture, errors);
}

void WarnWhereItDiffers(const BallLamp& lamp, const LightDescription& light, Warnings& warnings) {
  if (!light.position_m) return;
  const double off = Length(*light.position_m - lamp.position_m);
  if (off <= kPositionDiffers * Length(lamp.sd_m)) return;
  warnings.push_back({"position_differs", light.name,
                      "the mirror balls show it " + RoundedText(off, 2) +
                          " m from position_m, which is believed; leave position_m out to take "
                          "theirs"});
}

}  // namespace

Result<std::vector<BallPlacement>> PlaceByBalls(const Session& session, const Sources& sources,
                                                Evidence& evidence) {
  std::vector<BallPlacement> placed;
  for (const LightDescription& light : session.lights) {
    std::vector<BallRay> rays;
    std::optional<Metres> distance;
    for (const CaptureDescription& capture : session.captures) {
      if (capture.use != CaptureUse::kBall || capture.light != light.name) continue;
      auto ray = ReadBall(session, capture, sources, evidence);
      if (!ray) return AtCapture(capture, ray.error());
      rays.push_back(std::move(*ray));
      if (capture.distance) distance = capture.distance;
    }
    if (rays.empty()) continue;
    const auto lamp = LampOfRays(rays, distance);
    if (!lamp) return tl::unexpected(lamp.error());
    WarnWhereItDiffers(*lamp, light, evidence.warnings);
    placed.push_back({light.name, lamp->position_m, lamp->sd_m * kZ95});
  }
  return placed;
}

}  // namespace lightcal
