// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/punctual_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/preset_table.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::Not;

PunctualLight Converted(const FittedLight& lamp, Warnings& warnings) {
  const auto lights = PunctualLightsFrom(FileOf({lamp}), warnings);
  EXPECT_TRUE(lights.has_value());
  return lights->front();
}

TEST(Substitution, EveryKindWithoutACounterpartSaysSo) {
  for (const LightKind kind : {LightKind::kSphere, LightKind::kTube, LightKind::kDisk,
                               LightKind::kRect, LightKind::kPhotometric}) {
    Warnings warnings;
    const PunctualLight light = Converted(SimpleLight("lamp", kind, 100.0), warnings);
    EXPECT_THAT(warnings, Contains(Field(&Warning::code, "substituted"))) << LightKindName(kind);
    EXPECT_EQ(light.photometric, 100.0) << "the axial intensity is kept";
  }
  for (const FittedLight& lamp : {WarmPoint(), Spot(), Sun()}) {
    Warnings warnings;
    Converted(lamp, warnings);
    EXPECT_THAT(warnings, Not(Contains(Field(&Warning::code, "substituted")))) << lamp.name;
  }
}

// What the warning for a disk claims, by brute force over all angles.
TEST(Substitution, TheFlatSourcesSpotStraysAtMostSeventeenPercentAndLosesElevenOfFlux) {
  Warnings warnings;
  const PunctualLight light = Converted(SimpleLight("disk", LightKind::kDisk, 1.0), warnings);
  ASSERT_EQ(light.type, PunctualType::kSpot);
  const double ci = std::cos(light.cone.inner.value());
  const double co = std::cos(light.cone.outer.value());
  double worst = 0.0;
  double flux = 0.0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = (i + 0.5) * std::numbers::pi / 2.0 / kSteps;
    const double t = std::clamp((std::cos(theta) - co) / (ci - co), 0.0, 1.0);
    worst = std::max(worst, std::abs(t * t - std::cos(theta)));
    flux += t * t * std::sin(theta) * std::numbers::pi * std::numbers::pi / kSteps;
  }
  EXPECT_NEAR(worst, 0.1716, 1e-4);
  EXPECT_NEAR(flux / std::numbers::pi, 0.8954, 1e-4);  // of the Lambertian pi I0
}

TEST(Substitution, ASpotWithoutAConeBecomesAPointAndSaysWhy) {
  FittedLight lamp = Spot();
  lamp.outer_deg.reset();
  Warnings warnings;
  EXPECT_EQ(Converted(lamp, warnings).type, PunctualType::kPoint);
  EXPECT_THAT(warnings, Contains(Field(&Warning::code, "cone_unknown")));
}

TEST(Substitution, ADomeLightsUpwardSurfacesWithItsIlluminance) {
  FittedLight sky = Sun();
  sky.kind = LightKind::kDome;
  sky.illuminance_lx.reset();
  sky.luminance_nits = Uncertain{1000.0, 50.0, std::nullopt, std::nullopt};
  Warnings warnings;
  const PunctualLight light = Converted(sky, warnings);
  EXPECT_NEAR(IlluminanceAt(light, {5, 5, 5}, {0, 0, 1}).value(), 1000.0 * std::numbers::pi, 1e-9);
}

TEST(Colour, AnUnknownColourIsWhiteWithAWarning) {
  FittedLight lamp = SimpleLight("lamp", LightKind::kPoint, 10.0);
  lamp.color = {};
  Warnings warnings;
  const PunctualLight light = Converted(lamp, warnings);
  EXPECT_THAT(warnings, Contains(Field(&Warning::code, "color_unknown")));
  EXPECT_EQ(light.intensity, 10.0);
  EXPECT_EQ(light.color.max_normalised.b, 1.0);
}

TEST(Colour, OutOfGamutNamesTheClippedComponent) {
  FittedLight lamp = SimpleLight("candle", LightKind::kPoint, 1.0);
  lamp.color.cct_K = Uncertain{1500.0, 10.0, std::nullopt, std::nullopt};
  Warnings warnings;
  const PunctualLight light = Converted(lamp, warnings);
  EXPECT_LT(light.color.unit_luminance.b, 0.0);
  EXPECT_EQ(light.color.max_normalised.b, 0.0);
  ASSERT_THAT(warnings, Contains(Field(&Warning::code, "out_of_gamut")));
  EXPECT_THAT(warnings, Contains(Field(&Warning::message, HasSubstr("blue -"))));
}

TEST(Colour, MeasuredChromaticityGoesBeforeTheCct) {
  FittedLight lamp = SimpleLight("lamp", LightKind::kPoint, 1.0);
  lamp.color.xy = Xy{0.3127, 0.3290};
  Warnings warnings;
  const PunctualLight light = Converted(lamp, warnings);
  EXPECT_NEAR(light.color.unit_luminance.r, 1.0, 1e-12);
  EXPECT_NEAR(light.color.unit_luminance.b, 1.0, 1e-12);
}

// The interval of the exported intensity widens by the colour's share: d ln Y / dT by differences.
TEST(Uncertainty, TheColoursShareIsAddedInQuadrature) {
  FittedLight lamp = SimpleLight("lamp", LightKind::kPoint, 100.0);
  lamp.color.cct_K = Uncertain{2700.0, 100.0, std::nullopt, std::nullopt};
  const auto luminance_at = [&](double cct) {
    FittedLight other = lamp;
    other.color.cct_K->value = cct;
    Warnings ignored;
    return Converted(other, ignored).color.luminance;
  };
  const double color_share =
      50.0 * (std::log(luminance_at(2701.0)) - std::log(luminance_at(2699.0)));
  Warnings warnings;
  const PunctualLight light = Converted(lamp, warnings);
  EXPECT_NEAR(*light.intensity_u95 / light.intensity, std::hypot(0.1, color_share), 1e-4);
  EXPECT_GT(color_share, 0.02);
}

TEST(Refusal, ALightWithoutItsFigureIsRefusedNotGuessed) {
  Warnings warnings;
  FittedLight lamp = SimpleLight("lamp", LightKind::kPoint, 100.0);
  lamp.intensity_cd.reset();
  auto refused = PunctualLightsFrom(FileOf({lamp}), warnings);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, "no_intensity");
  EXPECT_EQ(refused.error().subject, "lamp");
  FittedLight sun = Sun();
  sun.illuminance_lx.reset();
  EXPECT_EQ(PunctualLightsFrom(FileOf({sun}), warnings).error().code, "no_illuminance");
  EXPECT_EQ(PunctualLightsFrom(FileOf({}), warnings).error().code, "no_lights");
}

TEST(Refusal, ANumberThatIsNotFiniteNeverReachesAFile) {
  FittedLight lamp = WarmPoint();
  lamp.intensity_cd->value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ExportGltf(FileOf({lamp}), "s", {}).error().code, "not_finite");
  lamp = WarmPoint();
  lamp.flux_lm->u95 = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ExportGltf(FileOf({lamp}), "s", {}).error().code, "not_finite");
  EXPECT_EQ(ExportJson(FileOf({lamp}), "s", {}).error().code, "not_finite");
}

TEST(Positions, LightsStackedAtTheOriginAreNamed) {
  Warnings warnings;
  const auto lights = PunctualLightsFrom(
      FileOf({SimpleLight("a", LightKind::kPoint, 1.0), SimpleLight("b", LightKind::kPoint, 1.0)}),
      warnings);
  ASSERT_TRUE(lights.has_value());
  ASSERT_THAT(warnings, Contains(Field(&Warning::code, "position_unknown")));
  EXPECT_EQ(warnings.back().subject, "a, b");
}

TEST(PresetTable, NamesTheNearestTarget) {
  ASSERT_TRUE(FindPresetTarget("gltf").has_value());
  const auto unknown = FindPresetTarget("gtlf");
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(unknown.error().message, HasSubstr("did you mean \"gltf\""));
  EXPECT_THAT(FindPresetTarget("xyzzy").error().message, HasSubstr("there are: gltf, "));
}

}  // namespace
}  // namespace lightcal::test
