// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/wall_capture.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/calibrate/captures/capture_reading.h"
#include "lightcal/calibrate/captures/capture_readings.h"
#include "lightcal/calibrate/captures/posed_wall.h"
#include "lightcal/calibrate/captures/wall_shadows.h"
#include "lightcal/core/as_one.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/fit/colour/other_light.h"
#include "lightcal/fit/distribution/fit_distribution.h"
#include "lightcal/fit/distribution/other_wall_light.h"
#include "lightcal/fit/model/budget.h"
#include "lightcal/fit/plan/plan_forward.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/imaging/scene/board_camera.h"
#include "lightcal/imaging/scene/wall_samples.h"
#include "lightcal/light/axial_shape.h"

namespace lightcal {
namespace {

constexpr double kLikelyVignetting = 3.0, kUnknownVignettingSd = 1.5, kKnownVignettingSd = 0.25;
constexpr double kGlossLightSd = 0.1, kGlossViewSd = 0.05;
constexpr double kBoardScaleSd = 0.002;
constexpr const char* kOtherLight = "other_light";

WallModel ModelOf(const LightDescription& light, const CaptureDescription& capture,
                  const PosedWall& wall) {
  WallModel model;
  model.camera = wall.camera.parameters;
  model.lamp_m = *light.position_m;
  model.reflectance = capture.reflectance;
  model.vignetting = capture.wall->vignetting.value_or(wall.picture.flat ? 0.0 : kLikelyVignetting);
  return model;
}

std::vector<DistributionShift> ShiftsOf(const WallDescription& description, const PosedWall& wall,
                                        const WallBlocks& blocks, const WallModel& model,
                                        const OtherLightFound& other) {
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
  for (const OtherWallLight& shift : other.shifts) {
    add(kOtherLight, [&](WallModel& moved) { moved.other = shift; });
  }
  return shifts;
}

// How much more than its intensity over the square of the distance a Lambertian lamp of this size
// would give the wall, were it small: relative, on its axis.
double NearFieldPart(const LightDescription& light) {
  AxialShape shape;
  if (light.diameter) shape = {AxialShape::Outline::kDisk, 0.5 * light.diameter->value()};
  if (light.width && light.height) {
    shape = {AxialShape::Outline::kRect, 0.5 * light.width->value(), 0.5 * light.height->value()};
  }
  return 1.0 / AxialShapeFactor(shape, -(*light.position_m)[1]) - 1.0;
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

FittedLight LightOf(const LightDescription& light, const PosedWall& wall,
                    FittedDistribution&& found, const Vec3& aim) {
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
  std::vector<fit::VariancePart> of_peak;
  for (const auto& part : found.budget) {
    measured.budget.push_back({part.name, part.peak, part.flux});
    of_peak.push_back({part.name, part.peak * part.peak});
  }
  out.budget = fit::BudgetOf(of_peak);
  out.distribution = std::move(measured);
  out.fit.readings = found.samples;
  out.fit.used = found.samples - found.rejected;
  out.fit.degrees_of_freedom = found.degrees_of_freedom;
  if (found.degrees_of_freedom > 0) out.fit.rms_relative = found.rms_relative;
  out.fit.learned = {"distribution"};
  if (wall.picture.scale_source == ScaleSource::kIsoPrior) out.fit.prior.emplace_back(kCameraScale);
  return out;
}

void WarnOf(const LightDescription& light, const CaptureDescription& capture, const PosedWall& wall,
            int saturated, const FittedDistribution& found, Warnings& warnings) {
  if (!capture.wall->vignetting && !wall.picture.flat) {
    warnings.push_back(
        {"vignetting_unknown", capture.where,
         "the lens's falloff is taken as cos^3, +-1.5 in the exponent (1 sigma); "
         "give vignetting = 0 for frames that were corrected by a flat field, or camera = a "
         "profile that has one"});
  }
  constexpr double kNoticed = 0.02;
  if (const double part = NearFieldPart(light); part > kNoticed) {
    warnings.push_back({"near_field", capture.light,
                        "a lamp of this size gives a wall so near up to " + PercentText(part) +
                            " less than from afar, which is in the interval: hang it ten times "
                            "its size away"});
  }
  if (saturated > 0) {
    warnings.push_back({"saturated_wall", capture.where,
                        std::to_string(saturated) +
                            " pieces of the wall are saturated in every frame and left out; "
                            "expose shorter"});
  }
  warnings.push_back({"not_measured", capture.light,
                      "nothing was seen beyond " + RoundedText(found.covered_deg, 3) +
                          " degrees from the aim: flux_lm is what leaves within that cone"});
  warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
}

struct Measured {
  FittedDistribution distribution;
  OtherLightFound other;
  double brightest_lx = 0.0;  // of the wall, other light in it
  double mean_lx = 0.0, mean_other_lx = 0.0;
  int saturated = 0;  // blocks left out
};

// What is left of the light on the wall when all that is not the lamp's own is taken off.
Result<Measured> MeasureDistribution(const Session& session, const CaptureDescription& capture,
                                     const LightDescription& light, const PosedWall& wall) {
  WallModel model = ModelOf(light, capture, wall);
  const auto blocks =
      BlocksOfWall(wall.picture.nits.view(), wall.picture.sigma_view(), wall.picture.selection,
                   WallCamera(model.camera), capture.wall->board);
  if (!blocks) return AtCapture(capture, blocks.error());
  DistributionData data;
  data.light = light.name;
  data.aim = light.aim.value_or(Vec3{0.0, 1.0, 0.0});
  const LampAsSeen seen = LampOf(IntensitiesOf(*blocks, model), data.aim, Metres(-model.lamp_m[1]));
  const std::vector<SeenPlace> lit = PlacesSeen(*blocks, model);
  const auto shadows = SeenInShadows(capture, wall.picture, model, lit);
  if (!shadows) return AtCapture(capture, shadows.error());
  const auto places = static_cast<double>(lit.size());
  double mean_lx = 0.0, mean_other_lx = 0.0;
  for (const SeenPlace& place : lit) mean_lx += place.lux / places;
  const OtherWallLight about{
      .foot_x_m = model.lamp_m[0], .foot_z_m = model.lamp_m[2], .distance_m = -model.lamp_m[1]};
  OtherLightFound other = FindOtherLight(PriorOfOtherLight(session, light, capture, mean_lx), seen,
                                         capture.reflectance, about, lit, *shadows);
  model.other = other.mean;
  for (const SeenPlace& place : lit) mean_other_lx += other.mean.At(place.x_m, place.z_m) / places;
  data.samples = IntensitiesOf(*blocks, model);
  data.shifts = ShiftsOf(*capture.wall, wall, *blocks, model, other);
  const double near_field = NearFieldPart(light);
  if (near_field > 0.0) {
    DistributionShift shift{"finite_source", data.samples};
    for (IntensitySample& sample : shift.samples) sample.intensity_cd *= 1.0 + near_field;
    data.shifts.push_back(std::move(shift));
  }
  // An anchor on the wall sets L / rho as a whole.
  const double reflectance_sd = capture.anchor_illuminance ? 0.0 : capture.reflectance_sigma;
  data.scale_sd = std::hypot(wall.picture.scale_sd, reflectance_sd);
  auto found = FitDistribution(data);
  if (!found) return AtCapture(capture, found.error());
  return Measured{
      *std::move(found), std::move(other), std::ranges::max(lit, {}, &SeenPlace::lux).lux,
      mean_lx,           mean_other_lx,    blocks->saturated};
}

// Shares of what the wall shows in the mean.
fit::OtherShares SharesOf(const Measured& measured) {
  const OtherLightFound& other = measured.other;
  fit::OtherShares out;
  if (!(other.mean.lux > 0.0)) return out;
  const double share = std::min(1.0, measured.mean_other_lx / measured.mean_lx);
  out.walls = share * other.of_room;
  out.common = (1.0 - out.walls) * other.sd_lx / other.mean.lux;
  out.ambient = share * other.of_ambient;
  return out;
}

FittedColor ColorOf(const Session& session, const LightDescription& light,
                    const CaptureDescription& capture, const WallPicture& picture,
                    const fit::OtherShares& shares, const FittedLight& found, Warnings& warnings) {
  const fit::OtherLight others(session, light, found);
  if (!picture.color) return fit::FitColor(session, light, &others, warnings).color;
  const auto& paint = capture.wall->paint_srgb;
  const fit::ColorOffWall seen{XyFromXyz(*picture.color),
                               GenericColorSigma(ClassOfLamp(session, light.name)),
                               fit::TintOfPaint(paint), shares};
  if (!paint) {
    warnings.push_back({"paint_unknown", capture.where,
                        "a wall's paint tints the light it throws back: its colour is taken for "
                        "what most walls' is, and the doubt is in the colour's interval; give "
                        "wall.paint_srgb = [red, green, blue], as the paint's maker prints it"});
  }
  return fit::FitColor(session, light, &others, warnings, CctMethod::kExact, &seen).color;
}

// Said where light beside the lamp's own is most of an interval's variance.
void WarnOfOtherLight(const CaptureDescription& capture, const Measured& measured,
                      Warnings& warnings) {
  constexpr double kMost = 0.5;
  double peak = 0.0, flux = 0.0, whole_peak = 0.0, whole_flux = 0.0;
  for (const auto& part : measured.distribution.budget) {
    whole_peak += part.peak * part.peak;
    whole_flux += part.flux * part.flux;
    if (part.name != kOtherLight) continue;
    peak = part.peak * part.peak;
    flux = part.flux * part.flux;
  }
  if (!(peak > kMost * whole_peak) && !(flux > kMost * whole_flux)) return;
  const OtherLightFound& other = measured.other;
  warnings.push_back(
      {"other_light", capture.where,
       RoundedText(other.mean.lux, 2) + " lx (\u00b1 " + RoundedText(kZ95 * other.sd_lx, 2) +
           ") of the " + RoundedText(measured.brightest_lx, 3) +
           " lx on the wall's brightest place are taken for light that the room throws back, or "
           "that others shine: hold a card into the beam near the lamp for the frames and give "
           "wall.shadows = [x, y, width, height] around its shadow; or state the room's size"});
}

EffectReport OtherLightReport(const Session& session, const CaptureDescription& capture,
                              const Measured& measured) {
  EffectReport out;
  const bool room = session.surroundings == Surroundings::kIndoors;
  const bool outdoors = session.surroundings == Surroundings::kOutdoors;
  out.name = room ? "room_bounce" : outdoors ? "ambient" : "veiling_glare";
  out.state = EffectState::kFitted;
  out.bound = measured.other.most_lx / measured.brightest_lx;
  out.contribution = measured.other.mean.lux / measured.brightest_lx;
  out.reason = capture.wall->shadows.empty()
                   ? "known by the flux that was seen, and not above the wall's darkest place"
                   : "measured in the card's shadow";
  out.key = room       ? "capture.wall.shadows, room.size_m"
            : outdoors ? "capture.wall.shadows, capture.wall.off_frames"
                       : "capture.lens_glare";
  return out;
}

// What the lamp did while it was photographed: its effects, its parts of the budget.
Result<std::vector<EffectReport>> WidenInTime(const Session& session,
                                              const CaptureDescription& capture,
                                              const LightDescription& light, const PosedWall& wall,
                                              const FitSettings& settings,
                                              FittedDistribution& found) {
  ScenePicture picture;
  picture.rows_s = capture.rows_s;
  picture.exposure_s = wall.picture.shortest_s;
  if (!capture.exposure_s.empty()) picture.exposure_s = std::ranges::min(capture.exposure_s);
  const double way_m =
      Length(*light.position_m) + Length(WallCamera(wall.camera.parameters).position_m());
  auto lamp = fit::FindLampInPictures(session, light, picture, way_m,
                                      capture.anchor_illuminance.has_value(), settings);
  if (!lamp) return Propagate(std::move(lamp));
  for (const fit::VariancePart& part : lamp->parts) {
    const double sd = std::sqrt(part.variance);
    WidenInLn(found.peak_cd, 1.0, sd);
    WidenInLn(found.flux_lm, 1.0, sd);
    found.budget.push_back({part.name, sd, sd});
  }
  return std::move(lamp->effects);
}

Result<FittedLight> MeasureWall(const Session& session, const CaptureDescription& capture,
                                const Sources& sources, const FitSettings& settings,
                                Evidence& evidence) {
  const LightDescription& light = *FindLight(session, capture.light);
  if (auto good = CheckLight(light); !good) return Propagate(std::move(good));
  const auto wall = ReadPosedWall(session, capture, sources, evidence);
  if (!wall) return AtCapture(capture, wall.error());
  auto measured = MeasureDistribution(session, capture, light, *wall);
  if (!measured) return Propagate(std::move(measured));
  WarnOf(light, capture, *wall, measured->saturated, measured->distribution, evidence.warnings);
  auto in_time = WidenInTime(session, capture, light, *wall, settings, measured->distribution);
  if (!in_time) return Propagate(std::move(in_time));
  WarnOfOtherLight(capture, *measured, evidence.warnings);
  EffectReport other = OtherLightReport(session, capture, *measured);
  const fit::OtherShares shares = SharesOf(*measured);
  FittedLight out = LightOf(light, *wall, std::move(measured->distribution),
                            light.aim.value_or(Vec3{0.0, 1.0, 0.0}));
  out.effects = {std::move(other)};
  std::ranges::move(*in_time, std::back_inserter(out.effects));
  out.color = ColorOf(session, light, capture, wall->picture, shares, out, evidence.warnings);
  return out;
}

}  // namespace

Result<std::vector<FittedLight>> MeasureWalls(const Session& session, const Sources& sources,
                                              const FitSettings& settings, Evidence& evidence) {
  std::vector<FittedLight> lights;
  std::vector<Error> refusals;
  for (const CaptureDescription& capture : session.captures) {
    if (capture.use != CaptureUse::kWall) continue;
    auto light = MeasureWall(session, capture, sources, settings, evidence);
    if (!light) {
      refusals.push_back(std::move(light).error());
      continue;
    }
    const bool again = std::ranges::find(lights, light->name, &FittedLight::name) != lights.end();
    if (again) {
      refusals.push_back(
          Refused("several_walls", capture.where,
                  "this light has a wall already; give each its own light, and compare")
              .value());
      continue;
    }
    lights.push_back(*std::move(light));
  }
  if (!refusals.empty()) return tl::unexpected(AsOne(std::move(refusals)));
  return lights;
}

}  // namespace lightcal
