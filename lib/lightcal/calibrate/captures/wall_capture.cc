// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/wall_capture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/calibrate/captures/capture_reading.h"
#include "lightcal/calibrate/captures/capture_readings.h"
#include "lightcal/calibrate/captures/wall_pictures.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/fit/distribution/fit_distribution.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/imaging/scene/board_camera.h"
#include "lightcal/imaging/scene/wall_samples.h"

namespace lightcal {
namespace {

constexpr double kLikelyVignetting = 3.0, kUnknownVignettingSd = 1.5, kKnownVignettingSd = 0.25;
constexpr double kGlossLightSd = 0.1, kGlossViewSd = 0.05;
constexpr double kBoardScaleSd = 0.002;

// What the pictures say of one wall.
struct Wall {
  WallPicture picture;
  SolvedCamera camera;
};

// The board by the camera that took the frames, where it stands.
Result<GreyPicture> PoseGrey(const Session& session, const CaptureDescription& capture,
                             const WallPicture& frames, const Sources& sources,
                             Evidence& evidence) {
  const std::string& name = capture.wall->board_frame;
  if (name.empty()) return frames.nits;
  const std::string path = PathInSession(session, name);
  auto grey = ReadGrey(sources, path);
  if (!grey) return grey;
  if (grey->width != frames.whole_width || grey->height != frames.whole_height) {
    return Refused("mixed_size", path,
                   "the picture of the board and the frames differ in size; one camera must take "
                   "both, from one place");
  }
  evidence.AddFile(path);
  return grey;
}

// Further views of the board; one where it cannot be found is left out and named.
Result<std::vector<std::vector<BoardCorner>>> FurtherViews(const Session& session,
                                                           const CaptureDescription& capture,
                                                           const WallPicture& first,
                                                           const Sources& sources,
                                                           Evidence& evidence) {
  std::vector<std::vector<BoardCorner>> views;
  if (capture.wall->board_views.empty()) return views;
  const std::vector<std::string> patterns = {PathInSession(session, capture.wall->board_views)};
  const auto files = sources.expand_files(patterns);
  if (!files) return tl::unexpected(files.error());
  for (const std::string& file : *files) {
    const auto grey = ReadGrey(sources, file);
    if (!grey) return tl::unexpected(grey.error());
    if (grey->width != first.whole_width || grey->height != first.whole_height) {
      return Refused("mixed_size", file,
                     "the views of the board must be as large as the frames, by the same lens");
    }
    evidence.AddFile(file);
    auto corners = sources.find_board(grey->view(), capture.wall->board);
    if (corners) {
      views.push_back(*std::move(corners));
    } else {
      evidence.warnings.push_back(
          {corners.error().code, file, corners.error().message + "; this view is left out"});
    }
  }
  return views;
}

// Places in a picture made smaller as places in the whole one.
void Enlarge(const Thinning& thinning, std::vector<BoardCorner>& corners) {
  for (BoardCorner& corner : corners) {
    corner.pixel = {thinning.n * (corner.pixel[0] - thinning.ThinX(0.0)),
                    thinning.n * (corner.pixel[1] - thinning.ThinY(0.0))};
  }
}

// The camera of the whole picture as one of the picture made smaller.
SolvedCamera CameraOfSmaller(SolvedCamera camera, const Thinning& thinning) {
  const double size = 1.0 / thinning.n;
  camera.parameters[kLnFocal] += std::log(size);
  camera.parameters[kCentreX] = thinning.ThinX(camera.parameters[kCentreX]);
  camera.parameters[kCentreY] = thinning.ThinY(camera.parameters[kCentreY]);
  for (const int centre : {kCentreX, kCentreY}) {
    for (int other = 0; other < kCameraParameters; ++other) {
      camera.covariance[static_cast<std::size_t>(centre * kCameraParameters + other)] *= size;
      camera.covariance[static_cast<std::size_t>(other * kCameraParameters + centre)] *= size;
    }
  }
  camera.rms_px *= size;
  camera.sigma_px *= size;
  return camera;
}

Result<Wall> ReadWall(const Session& session, const CaptureDescription& capture,
                      const Sources& sources, Evidence& evidence) {
  auto picture = ReadWallPicture(session, capture, sources, evidence);
  if (!picture) return Propagate(std::move(picture));
  evidence.pictures.push_back(RecordedOf(capture, picture->nits.view()));
  const auto grey = PoseGrey(session, capture, *picture, sources, evidence);
  if (!grey) return tl::unexpected(grey.error());
  auto corners = sources.find_board(grey->view(), capture.wall->board);
  if (!corners) return Propagate(std::move(corners));
  // In the camera's own pixels, as those of further views.
  if (capture.wall->board_frame.empty()) Enlarge(picture->thinning, *corners);
  const auto further = FurtherViews(session, capture, *picture, sources, evidence);
  if (!further) return tl::unexpected(further.error());
  std::vector<std::vector<BoardCorner>> views = {*std::move(corners)};
  views.insert(views.end(), further->begin(), further->end());
  std::optional<double> focal_px;
  if (grey->focal_length && capture.wall->sensor_width) {
    focal_px = *grey->focal_length / *capture.wall->sensor_width * picture->whole_width;
  }
  auto camera = SolveCamera(views, picture->whole_width, picture->whole_height, focal_px);
  if (!camera) return Propagate(std::move(camera));
  const SolvedCamera thinned = CameraOfSmaller(*camera, picture->thinning);
  return Wall{*std::move(picture), thinned};
}

WallModel ModelOf(const LightDescription& light, const CaptureDescription& capture,
                  const Wall& wall) {
  WallModel model;
  model.camera = wall.camera.parameters;
  model.lamp_m = *light.position_m;
  model.reflectance = capture.reflectance;
  model.vignetting = capture.wall->vignetting.value_or(wall.picture.flat ? 0.0 : kLikelyVignetting);
  return model;
}

std::vector<DistributionShift> ShiftsOf(const WallDescription& description, const Wall& wall,
                                        const WallBlocks& blocks, const WallModel& model) {
  std::vector<DistributionShift> shifts;
  const auto add = [&](const char* name, const auto& change) {
    WallModel moved = model;
    change(moved);
    shifts.push_back({name, IntensitiesOf(blocks, moved)});
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add("lamp_position",
        [&](WallModel& moved) { moved.lamp_m[axis] += description.position_sigma_m; });
  }
  for (const CameraParameters& parameters : OneSigmaShifts(wall.camera)) {
    add("camera", [&](WallModel& moved) { moved.camera = parameters; });
  }
  const bool known = description.vignetting || wall.picture.flat;
  const double sd = known ? kKnownVignettingSd : kUnknownVignettingSd;
  add("vignetting", [&](WallModel& moved) { moved.vignetting += sd; });
  add("not_matt", [](WallModel& moved) { moved.gloss_light += kGlossLightSd; });
  add("not_matt", [](WallModel& moved) { moved.gloss_view += kGlossViewSd; });
  add("board_size", [](WallModel& moved) { moved.board_scale += kBoardScaleSd; });
  return shifts;
}

WallSelection SelectionOf(const CaptureDescription& capture, const Thinning& thinning) {
  WallSelection selection;
  const auto region = [&](const std::array<int, 4>& r) {
    return ThinRegion({r[0], r[1], r[2], r[3]}, thinning);
  };
  if (capture.rect) selection.wall = region(*capture.rect);
  // All that a mask touches: a block more on each side.
  const int more = thinning.n == 1 ? 0 : thinning.n * std::max(thinning.columns, thinning.rows);
  for (const auto& mask : capture.wall->masks) {
    const int x = std::max(0, mask[0] - more), y = std::max(0, mask[1] - more);
    selection.masks.push_back(
        region({x, y, mask[0] + mask[2] + more - x, mask[1] + mask[3] + more - y}));
  }
  selection.board_hangs = capture.wall->board_frame.empty();
  return selection;
}

Result<void> CheckLight(const LightDescription& light) {
  if (light.kind != LightKind::kPhotometric) {
    return Refused("wall_needs_photometric", light.name,
                   "a wall measures a distribution, which is of kind = \"photometric\"");
  }
  if (!light.position_m) {
    return Refused("position_unknown", light.name,
                   "give position_m = [x, y, z] from the board's lower left corner: x to the "
                   "right, y into the wall (negative in front of it), z up");
  }
  if (!((*light.position_m)[1] < 0.0)) {
    return Refused("not_in_front", light.name,
                   "position_m has y = " + ShortestText((*light.position_m)[1]) +
                       ", which is not in front of the wall: y points into it");
  }
  return {};
}

FittedColor ColorOf(const Session& session, const LightDescription& light,
                    const CaptureDescription& capture, const WallPicture& picture,
                    Warnings& warnings) {
  Session with = session;
  if (picture.xy) {
    Reading reading;
    reading.light = light.name;
    reading.xy = picture.xy;
    reading.color_source = ColorSource::kCamera;
    reading.sigma_mired = GenericColorSigma(capture.lamp_class);
    with.readings.push_back({std::move(reading), capture.where});
  }
  return fit::FitColor(with, light, nullptr, warnings).color;
}

FittedLight LightOf(const LightDescription& light, const Wall& wall, FittedDistribution&& found,
                    const Vec3& aim) {
  FittedLight out;
  out.name = light.name;
  out.kind = LightKind::kPhotometric;
  out.intensity_cd = found.peak_cd;
  out.flux_lm = found.flux_lm;
  out.position_m = light.position_m;
  out.aim = aim;
  if (light.diameter) out.diameter_m = light.diameter->value();
  if (light.width) out.width_m = light.width->value();
  if (light.height) out.height_m = light.height->value();
  MeasuredDistribution measured{std::move(found.table), found.interpolated_share};
  for (const auto& part : found.budget) {
    measured.budget.push_back({part.name, part.peak, part.flux});
  }
  out.distribution = std::move(measured);
  out.fit.readings = found.samples;
  out.fit.used = found.samples - found.rejected;
  out.fit.degrees_of_freedom = found.degrees_of_freedom;
  if (found.degrees_of_freedom > 0) out.fit.rms_relative = found.rms_relative;
  out.fit.learned = {"distribution"};
  if (wall.picture.scale_source == ScaleSource::kIsoPrior)
    out.fit.prior.emplace_back(kCameraScalePrior);
  return out;
}

void WarnOf(const CaptureDescription& capture, const Wall& wall, const WallBlocks& blocks,
            const FittedDistribution& found, Warnings& warnings) {
  if (!capture.wall->vignetting && !wall.picture.flat) {
    warnings.push_back(
        {"vignetting_unknown", capture.where,
         "the lens's falloff is taken as cos^3, +-1.5 in the exponent (1 sigma); "
         "give vignetting = 0 for frames that were corrected by a flat field, or camera = a "
         "profile that has one"});
  }
  if (blocks.saturated > 0) {
    warnings.push_back({"saturated_wall", capture.where,
                        std::to_string(blocks.saturated) +
                            " pieces of the wall are saturated in every frame and left out; "
                            "expose shorter"});
  }
  warnings.push_back({"not_measured", capture.light,
                      "nothing was seen beyond " + RoundedText(found.covered_deg, 3) +
                          " degrees from the aim: flux_lm is what leaves within that cone"});
  warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
}

Result<FittedLight> MeasureWall(const Session& session, const CaptureDescription& capture,
                                const Sources& sources, Evidence& evidence) {
  const LightDescription& light = *FindLight(session, capture.light);
  if (auto good = CheckLight(light); !good) return Propagate(std::move(good));
  const auto wall = ReadWall(session, capture, sources, evidence);
  if (!wall) return AtCapture(capture, wall.error());
  const WallModel model = ModelOf(light, capture, *wall);
  const auto blocks = BlocksOfWall(wall->picture.nits.view(), wall->picture.sigma_view(),
                                   SelectionOf(capture, wall->picture.thinning),
                                   WallCamera(model.camera), capture.wall->board);
  if (!blocks) return AtCapture(capture, blocks.error());
  DistributionData data;
  data.light = light.name;
  data.aim = light.aim.value_or(Vec3{0.0, 1.0, 0.0});
  data.samples = IntensitiesOf(*blocks, model);
  data.shifts = ShiftsOf(*capture.wall, *wall, *blocks, model);
  // An anchor on the wall sets L / rho as a whole.
  const double reflectance_sd = capture.anchor_illuminance ? 0.0 : capture.reflectance_sigma;
  data.scale_sd = std::hypot(wall->picture.scale_sd, reflectance_sd);
  auto found = FitDistribution(data);
  if (!found) return AtCapture(capture, found.error());
  WarnOf(capture, *wall, *blocks, *found, evidence.warnings);
  FittedColor color = ColorOf(session, light, capture, wall->picture, evidence.warnings);
  FittedLight out = LightOf(light, *wall, *std::move(found), data.aim);
  out.color = std::move(color);
  return out;
}

}  // namespace

Result<std::vector<FittedLight>> MeasureWalls(const Session& session, const Sources& sources,
                                              Evidence& evidence) {
  std::vector<FittedLight> lights;
  for (const CaptureDescription& capture : session.captures) {
    if (capture.use != CaptureUse::kWall) continue;
    auto light = MeasureWall(session, capture, sources, evidence);
    if (!light) return Propagate(std::move(light));
    const bool again = std::ranges::find(lights, light->name, &FittedLight::name) != lights.end();
    if (again) {
      return Refused("several_walls", capture.where,
                     "this light has a wall already; give each its own light, and compare");
    }
    lights.push_back(*std::move(light));
  }
  return lights;
}

}  // namespace lightcal
