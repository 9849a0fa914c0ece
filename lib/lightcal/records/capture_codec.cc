// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/capture_codec.h"

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/records/wall_capture_codec.h"

namespace lightcal::records {

void ReadRect(FieldReader& reader, std::optional<std::array<int, 4>>& out) {
  std::vector<int> rect;
  reader.Integers("rect", rect);
  if (!reader.Has("rect") || reader.Failed()) return;
  if (rect.size() != 4 || rect[0] < 0 || rect[1] < 0 || rect[2] < 1 || rect[3] < 1) {
    reader.Fail("rect", "rect = [x, y, width, height] in pixels, from the upper left corner");
    return;
  }
  out = {rect[0], rect[1], rect[2], rect[3]};
}

namespace {

void ReadBall(FieldReader& reader, BallDescription& ball) {
  reader.Number("diameter_m", ball.diameter, kPositive);
  ReadRect(reader, ball.rect);
  reader.Array("camera_position_m", ball.camera_position_m);
  reader.Array("camera_aim", ball.camera_aim);
  reader.Degrees("camera_roll_deg", ball.camera_roll, kAnyNumber);
  reader.Require({"diameter_m", "rect", "camera_position_m", "camera_aim"});
  if (ball.camera_aim && *ball.camera_aim == Vec3{}) {
    reader.Fail("camera_aim", "camera_aim = [0, 0, 0] is no direction");
  }
}

void ReadProjection(FieldReader& reader, CaptureDescription& capture) {
  Projection projection = Projection::kRectilinear;
  reader.Word("projection", projection, kProjectionWords);
  if (reader.Has("projection")) capture.projection = projection;
  reader.Degrees("fov_deg", capture.field_of_view, kFullAngleRule);
}

// What must be there for what the pictures are used for.
void RequireForUse(FieldReader& reader, CaptureUse use) {
  switch (use) {
    case CaptureUse::kCard:
      reader.Require({"reflectance"});
      return;
    case CaptureUse::kWall:
      reader.Require({"reflectance", "wall"});
      return;
    case CaptureUse::kSource:
      reader.Require({"distance_m", "fov_deg"});
      return;
    case CaptureUse::kDome:
      return;
    case CaptureUse::kBall:
      reader.Require({"ball", "fov_deg"});
      return;
  }
}

// The uses that hear a key.
constexpr unsigned Uses(std::initializer_list<CaptureUse> uses) {
  unsigned bits = 0;
  for (const CaptureUse use : uses) bits |= 1U << static_cast<unsigned>(use);
  return bits;
}
struct HeardBy {
  std::string_view key;
  unsigned uses;
};
constexpr unsigned kPatches = Uses({CaptureUse::kCard, CaptureUse::kSource, CaptureUse::kWall});
constexpr unsigned kLenses = Uses({CaptureUse::kSource, CaptureUse::kDome, CaptureUse::kBall});
constexpr std::array<HeardBy, 17> kHeard = {{
    {"reflectance", Uses({CaptureUse::kCard, CaptureUse::kWall})},
    {"reflectance_sigma_relative", Uses({CaptureUse::kCard, CaptureUse::kWall})},
    {"tilt_deg", Uses({CaptureUse::kCard})},
    {"distance_m", Uses({CaptureUse::kCard, CaptureUse::kSource, CaptureUse::kBall})},
    {"rect", kPatches},
    {"exposure_s", kPatches},
    {"f_number", kPatches},
    {"iso", kPatches},
    {"camera", kPatches},
    {"response", kPatches},
    {"nd", kPatches},
    {"spectrum", kPatches},
    {"rows_s", kPatches},
    {"lens_glare", kPatches},
    {"projection", kLenses},
    {"fov_deg", kLenses},
    {"anchor_illuminance_lx", kPatches | Uses({CaptureUse::kDome})},
}};

// What changes nothing is no part of a capture: whoever writes it thinks that it does.
void RefuseUnheard(FieldReader& reader, CaptureUse use) {
  for (const HeardBy& one : kHeard) {
    if ((one.uses & Uses({use})) != 0 || !reader.Has(one.key)) continue;
    const std::string key(one.key);
    reader.Fail(key, key + " tells nothing where use = \"" +
                         std::string(kCaptureUseWords[static_cast<std::size_t>(use)]) +
                         "\"; leave it out");
  }
}

void CheckCompanions(FieldReader& reader, const CaptureDescription& capture) {
  if (!capture.spectrum_file.empty() && capture.camera.empty()) {
    reader.Fail("spectrum",
                "spectrum tells how far the camera misreads this lamp, and needs "
                "camera = a file of its spectral sensitivities");
  }
  if (!capture.nd.empty() && capture.camera.empty()) {
    reader.Fail("nd", "nd names a filter of the camera's profile, and needs camera = that profile");
  }
  const bool is_wall = capture.use == CaptureUse::kWall;
  if (capture.wall && !is_wall) {
    reader.Fail("wall", "wall describes pictures of a lit wall, and needs use = \"wall\"");
  }
  if (is_wall && capture.wall &&
      capture.wall->anchor_rect.has_value() != capture.anchor_illuminance.has_value()) {
    reader.Fail("wall",
                "anchor_illuminance_lx and wall.anchor_rect, where on the wall it was read, "
                "need each other");
  }
  if (capture.ball && capture.use != CaptureUse::kBall) {
    reader.Fail("ball", "ball describes pictures of a mirror ball, and needs use = \"ball\"");
  }
  if (!capture.meter.empty() && !capture.anchor_illuminance) {
    reader.Fail("meter", "meter names what read anchor_illuminance_lx, which is missing");
  }
}

}  // namespace

void ReadCapture(FieldReader& reader, CaptureDescription& capture) {
  reader.Text("light", capture.light);
  reader.Text("frames", capture.frames);
  reader.Text("camera", capture.camera);
  reader.Text("response", capture.response);
  reader.Text("nd", capture.nd);
  reader.Word("use", capture.use, kCaptureUseWords);
  reader.Number("reflectance", capture.reflectance, kCardRule);
  reader.Number("reflectance_sigma_relative", capture.reflectance_sigma, kSigmaRule);
  reader.Number("distance_m", capture.distance, kDistanceRule);
  reader.Degrees("tilt_deg", capture.tilt, kTiltRule);
  ReadRect(reader, capture.rect);
  reader.Numbers("exposure_s", capture.exposure_s, kPositive);
  reader.Number("f_number", capture.f_number, kPositive);
  reader.Number("iso", capture.iso, kPositive);
  reader.Number("anchor_illuminance_lx", capture.anchor_illuminance, kPositive);
  reader.Text("meter", capture.meter);
  reader.Word("lamp_class", capture.lamp_class, kLampClassWords);
  reader.Text("spectrum", capture.spectrum_file);
  reader.Number("rows_s", capture.rows_s, kNotNegative);
  reader.Number("lens_glare", capture.lens_glare, kErrorFractionRule);
  reader.Object("wall", capture.wall, ReadWall);
  reader.Object("ball", capture.ball, ReadBall);
  ReadProjection(reader, capture);
  reader.Require({"light", "frames", "use"});
  if (!reader.Failed()) RequireForUse(reader, capture.use);
  reader.Finish();
  if (!reader.Failed()) RefuseUnheard(reader, capture.use);
  if (!reader.Failed()) CheckCompanions(reader, capture);
}

}  // namespace lightcal::records
