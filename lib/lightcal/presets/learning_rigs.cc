// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/learning_rigs.h"

#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/presets/environment_picture.h"
#include "lightcal/presets/export_targets.h"

namespace lightcal {
namespace {

constexpr double kCardsAt_m = 1.7;  // neither it nor its square is another mistake's factor
constexpr double kRelativeU95 = 0.001;

FittedLight LearningLamp(LightKind kind, double value) {
  FittedLight lamp;
  lamp.name = LightKindName(kind);
  lamp.kind = kind;
  Uncertain measured;
  measured.value = value;
  measured.u95 = value * kRelativeU95;
  if (kind == LightKind::kDirectional || kind == LightKind::kDome) {
    lamp.illuminance_lx = measured;
  } else {
    lamp.intensity_cd = measured;
    lamp.position_m = Vec3{0.3, -0.2, 2.5};
  }
  if (kind != LightKind::kDome) {
    lamp.aim = Vec3{0.48, 0.36, -0.8};
    lamp.color.xy = Xy{0.45986, 0.41060};  // CIE 15, Planckian locus, 2700 K
    ResidualRow row;
    row.distance_m = kCardsAt_m;
    row.measured_lx = row.predicted_lx = value / (kCardsAt_m * kCardsAt_m);
    lamp.residuals.push_back(row);
  }
  lamp.fit.readings = lamp.fit.used = 1;
  return lamp;
}

FittedLight SpotLamp() {
  FittedLight lamp = LearningLamp(LightKind::kSpot, 4000.0);
  lamp.inner_deg = 10.0;
  lamp.outer_deg = 38.0;
  return lamp;
}

FittedLight SunLamp() {
  FittedLight lamp = LearningLamp(LightKind::kDirectional, 9000.0);
  lamp.angular_diameter_deg = 0.53;
  return lamp;
}

FittedLight RoundLamp(LightKind kind, double diameter_m) {
  FittedLight lamp = LearningLamp(kind, 300.0);
  lamp.diameter_m = diameter_m;
  return lamp;
}

FittedLight RectLamp() {
  FittedLight lamp = LearningLamp(LightKind::kRect, 600.0);
  lamp.width_m = 0.5;
  lamp.height_m = 0.3;
  return lamp;
}

FittedLight TubeLamp() {
  FittedLight lamp = LearningLamp(LightKind::kTube, 200.0);
  lamp.length_m = 1.2;
  lamp.radius_m = 0.02;
  return lamp;
}

// Six soft sides, each of a luminance and a colour of its own, which no turn or mirror takes into
// one another.
struct Side {
  Vec3 way, rgb_nits;
};
constexpr std::array<Side, 6> kSides = {{{{1, 0, 0}, {3000, 900, 600}},
                                         {{-1, 0, 0}, {300, 1500, 450}},
                                         {{0, 1, 0}, {180, 240, 600}},
                                         {{0, -1, 0}, {300, 300, 60}},
                                         {{0, 0, 1}, {1440, 1920, 2400}},
                                         {{0, 0, -1}, {135, 90, 60}}}};

std::shared_ptr<const EnvironmentPicture> LearningSky() {
  constexpr int kWidth = 256, kHeight = kWidth / 2;
  auto picture = std::make_shared<EnvironmentPicture>();
  picture->width = kWidth;
  picture->height = kHeight;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Vec3 d = PixelDirection(x, y, kWidth, kHeight);
      Vec3 sum{};
      double weights = 0.0;
      for (const Side& side : kSides) {
        const double weight = std::pow(std::max(0.0, Dot(d, side.way)), 4.0);
        sum = sum + side.rgb_nits * weight;
        weights += weight;
      }
      for (const double c : sum) picture->rgb.push_back(static_cast<float>(c / weights));
    }
  }
  picture->Reduce();
  return picture;
}

struct LearningRig {
  FittedLight lamp;
  std::vector<RigPlace> beside{};
  std::shared_ptr<const EnvironmentPicture> sky{};
};

std::vector<LearningRig> AllLearningRigs() {
  std::vector<LearningRig> rigs;
  rigs.push_back({LearningLamp(LightKind::kPoint, 900.0)});
  rigs.push_back({SpotLamp(), {{14.0, 0.0}, {24.0, 0.0}, {33.0, 0.0}}});
  rigs.push_back({SunLamp()});
  rigs.push_back({RoundLamp(LightKind::kSphere, 0.1)});
  rigs.push_back({RoundLamp(LightKind::kDisk, 0.4)});
  rigs.push_back({RectLamp()});
  rigs.push_back({TubeLamp()});
  const auto sky = LearningSky();
  const Vec3 up = IrradianceOn(*sky, {0.0, 0.0, 1.0});
  const double lux = LuminanceOfRgb({up[0], up[1], up[2]}, RgbSpace::kSrgb);
  rigs.push_back({LearningLamp(LightKind::kDome, lux),
                  {{90.0, 0.0}, {90.0, 90.0}, {90.0, 180.0}, {90.0, 270.0}},
                  sky});
  return rigs;
}

}  // namespace

Result<std::vector<PresetFile>> LearningRigs(const std::string& target,
                                             const PresetOptions& options,
                                             std::string_view generator) {
  std::vector<PresetFile> files;
  for (LearningRig& rig : AllLearningRigs()) {
    LightFile lights;
    const std::string stem = rig.lamp.name;
    lights.lights.push_back(std::move(rig.lamp));
    lights.provenance.generator = generator;
    PresetOptions one = options;
    one.rig = true;
    one.more_rigs = std::move(rig.beside);
    one.environments = {rig.sky};
    auto exported = ExportTargets(lights, {target, "json"}, stem, one);
    if (!exported) return Propagate(std::move(exported));
    // The lights alone are nothing to render.
    std::erase_if(exported->files, [&](const PresetFile& file) {
      return file.name.starts_with(stem + ".") && !file.name.starts_with(stem + ".rig");
    });
    std::ranges::move(exported->files, std::back_inserter(files));
  }
  return files;
}

}  // namespace lightcal
