// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightcal/presets/rig.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr EngineForms kAll = {
    .sphere = true, .disk = true, .rect = true, .tube = true, .table = true, .dome = true};

PresetLight Made(const FittedLight& lamp, const EngineForms& forms = kAll,
                 const PresetOptions& options = {}, Warnings* warnings = nullptr) {
  Warnings ignored;
  auto lights = PresetLightsFrom(FileOf({lamp}), forms, options, warnings ? *warnings : ignored);
  EXPECT_TRUE(lights);
  return std::move(lights->front());
}

FittedLight Disk() {
  FittedLight lamp = SimpleLight("disk", LightKind::kDisk, 50.0);
  lamp.diameter_m = 0.2;
  return lamp;
}

TEST(PresetLight, LuminanceAndFluxOfAreaFormsAreTheirClosedForms) {
  FittedLight rect = SimpleLight("panel", LightKind::kRect, 900.0);
  rect.width_m = 0.6;
  rect.height_m = 0.3;
  EXPECT_NEAR(Made(rect).nits, 5000.0, 1e-9);
  EXPECT_NEAR(Made(rect).lumens, 900.0 * kPi, 1e-9);
  FittedLight sphere = SimpleLight("globe", LightKind::kSphere, 50.0);
  sphere.diameter_m = 0.2;
  EXPECT_NEAR(Made(sphere).nits, 50.0 / (kPi * 0.01), 1e-9);
  // 4 pi^2 r^2 L
  EXPECT_NEAR(Made(sphere).lumens, 4.0 * kPi * kPi * 0.01 * Made(sphere).nits, 1e-9);
  FittedLight tube = SimpleLight("tube", LightKind::kTube, 100.0);
  tube.length_m = 1.2;
  tube.radius_m = 0.013;
  EXPECT_NEAR(Made(tube).nits, 100.0 / (1.2 * 0.026), 1e-9);
  FittedLight dome = Sun();
  dome.kind = LightKind::kDome;
  EXPECT_NEAR(Made(dome).nits, 98000.0 / kPi, 1e-9);
  FittedLight sun = Sun();
  sun.angular_diameter_deg = 0.53;
  EXPECT_NEAR(Made(sun).nits / 1.458e9, 1.0, 1e-3);  // engines.md, section 3
}

// On the axis of a disk E = I/(d^2 + R^2): the near field belongs to the form.
TEST(PresetLight, AreaFormsCastTheirNearFieldAndPointsDoNot) {
  const Vec3 at = {0, 0, -0.5};
  EXPECT_NEAR(IlluminanceAt(Made(Disk()), at, {0, 0, 1}).value(), 50.0 / (0.25 + 0.01), 1e-9);
  EXPECT_NEAR(IlluminanceAt(Made(Disk(), {}), at, {0, 0, 1}).value(), 50.0 / 0.25, 1e-9);
}

TEST(PresetLight, ADiskBecomesASquareOfItsAreaWhereOnlyRectanglesAre) {
  Warnings warnings;
  const PresetLight light = Made(Disk(), {.rect = true}, {}, &warnings);
  EXPECT_EQ(light.form, LightForm::kRect);
  EXPECT_NEAR(light.width_m * light.height_m, kPi * 0.01, 1e-12);
  EXPECT_NEAR(light.nits, Made(Disk()).nits, 1e-9);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "substituted");
  // The error it states, at one and at two diameters.
  const auto ratio = [&](double d) {
    return IlluminanceAt(light, {0, 0, -d}, {0, 0, 1}) /
           IlluminanceAt(Made(Disk()), {0, 0, -d}, {0, 0, 1});
  };
  EXPECT_NEAR(ratio(0.2), 1.0 - 0.0073, 1e-4);  // brute-force sum over the square
  EXPECT_NEAR(ratio(0.4), 1.0 - 0.0026, 1e-4);
}

TEST(PresetLight, AKindWithoutItsSizeIsTheNearestPunctualLight) {
  Warnings warnings;
  const PresetLight light = Made(SimpleLight("panel", LightKind::kRect, 10.0), kAll, {}, &warnings);
  EXPECT_EQ(light.form, LightForm::kSpot);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "substituted");
}

// Y of the max-normalised colour against the reference's table (Krystek's locus, 3 decimals) and
// against each space's own luminance row, computed here from its primaries.
TEST(PresetColor, TheDivisorFollowsTheSpace) {
  FittedLight lamp = SimpleLight("lamp", LightKind::kPoint, 100.0);
  lamp.color.cct_K = Uncertain{2700.0, 10.0, std::nullopt, std::nullopt};
  EXPECT_NEAR(Made(lamp).color().luminance, 0.517, 0.004);
  PresetOptions wide;
  wide.color.space = RgbSpace::kRec2020;
  const PresetLight light = Made(lamp, kAll, wide);
  const Rgb& c = light.color().max_normalised;
  EXPECT_NEAR(light.color().luminance, 0.2627 * c.r + 0.6780 * c.g + 0.0593 * c.b, 1e-4);
  EXPECT_NEAR(light.punctual.intensity * light.color().luminance, 100.0, 1e-9);
}

TEST(PresetColor, AWhiteOfThePipelineBecomesRedEqualGreenEqualBlue) {
  FittedLight lamp = SimpleLight("lamp", LightKind::kPoint, 100.0);
  lamp.color.xy = Xy{0.4234, 0.3990};
  for (const RgbSpace space : kRgbSpaces) {
    PresetOptions options;
    options.color = {.space = space, .white = lamp.color.xy};
    const PresetLight light = Made(lamp, kAll, options);
    EXPECT_NEAR(light.color().unit_luminance.r, 1.0, 1e-9);
    EXPECT_NEAR(light.color().unit_luminance.g, 1.0, 1e-9);
    EXPECT_NEAR(light.color().unit_luminance.b, 1.0, 1e-9);
    EXPECT_NEAR(light.punctual.intensity, 100.0, 1e-6);
  }
}

TEST(PresetRig, ExposureFollowsTheFormAndCardsAreSquare) {
  FittedLight disk = Disk();
  ResidualRow row;
  row.distance_m = 0.5;
  row.measured_lx = 190.0;
  disk.residuals.push_back(row);
  const LightFile file = FileOf({disk});
  Warnings warnings;
  const auto lights = PresetLightsFrom(file, kAll, {}, warnings);
  ASSERT_TRUE(lights);
  const Rig rig = BuildRig(file, *lights);
  const double offset = rig.side.value() * 0.55;
  const double d = std::hypot(0.5, offset);
  // Off the axis by half a card: within 1 % of the axial closed form at that distance times cos^2.
  EXPECT_NEAR(rig.cards[0].illuminance.value() / (50.0 / (0.25 + 0.01)), std::pow(0.5 / d, 4.0),
              0.01);
  EXPECT_NEAR(rig.exposure.scale * rig.cards[0].illuminance.value() / kPi, 1.0, 1e-12);
  const auto corners = CornersOf(rig, rig.cards[1]);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(Length(corners[(i + 1) % 4] - corners[i]), rig.side.value(), 1e-12);
  }
  const Vec3 normal = Cross(corners[1] - corners[0], corners[2] - corners[1]);
  EXPECT_GT(Dot(normal, rig.normal), 0.0) << "counter-clockwise seen from the lamp";
}

// A tube as many short ones, each shining as the sine of the angle from its length.
double LuxOfTube(double candela, double length_m, const Vec3& along, const Vec3& at,
                 const Vec3& normal) {
  constexpr int kParts = 2000;
  double lux = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const Vec3 to = at - along * (length_m * ((i + 0.5) / kParts - 0.5));
    const double d = Length(to);
    const double sine = Length(Cross(along, to)) / d;
    lux += candela / kParts * sine * std::max(0.0, -Dot(normal, to) / d) / (d * d);
  }
  return lux;
}

TEST(PresetLight, ATubeAndARectHangAsTheirAxisSays) {
  FittedLight tube = SimpleLight("tube", LightKind::kTube, 100.0);
  tube.length_m = 1.2;
  tube.radius_m = 0.005;
  const Vec3 side = {1.5, 0.3, 0.4}, normal = {-1, 0, 0};
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0.6, 0.8, 0}}) {
    tube.axis = axis;
    EXPECT_NEAR(
        IlluminanceAt(Made(tube), side, normal).value() / LuxOfTube(100.0, 1.2, axis, side, normal),
        1.0, 0.01);
  }
  FittedLight rect = SimpleLight("panel", LightKind::kRect, 900.0);
  rect.width_m = 1.0;
  rect.height_m = 0.2;
  rect.aim = Vec3{0, 1, 0};
  rect.axis = Vec3{0, 0, 1};  // upright
  const PresetLight upright = Made(rect);
  EXPECT_NEAR(upright.axes.c0[2], 1.0, 1e-12);
  EXPECT_NEAR(upright.axes.c90[0], -1.0, 1e-12);
  const Vec3 above = {0, 0.3, 0.6}, beside = {0.6, 0.3, 0}, back = {0, -1, 0};
  EXPECT_GT(IlluminanceAt(upright, above, back).value(),
            1.5 * IlluminanceAt(upright, beside, back).value());
}

}  // namespace
}  // namespace lightcal::test
