// SPDX-License-Identifier: Apache-2.0
// The laws are written out again here, from the reference, so that the refit is judged by others.
#include "lightcal/presets/falloff_refit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sample_lights.h"

namespace lightcal::test {
namespace {

struct Engine {
  const char* name;
  EngineFalloff law;
  double ranges_of_farthest;  // the bar
  std::function<double(double, double)> lux_per_candela;
};

double Window(double d, double r) { return std::max(0.0, 1.0 - std::pow(d / r, 4.0)); }

constexpr EngineFalloff kFilament{&FilamentFalloff};
constexpr EngineFalloff kHdrp{[](Metres d, Metres r) { return UnityHdrpFalloff(d, r); }};
constexpr EngineFalloff kThree{[](Metres d, Metres r) { return ThreeJsFalloff(d, r); }};
constexpr EngineFalloff kGltf{&GltfFalloff, WindowPower::kPlain};
constexpr EngineFalloff kUnreal{&UnrealFalloff};
constexpr EngineFalloff kGodot{[](Metres d, Metres r) { return GodotFalloff(d, r); }};

const Engine kEngines[] = {
    {"Filament", kFilament, 4.47,
     [](double d, double r) { return std::pow(Window(d, r), 2) / std::max(d * d, 1e-4); }},
    {"HDRP", kHdrp, 4.47,
     [](double d, double r) { return std::pow(Window(d, r) * std::min(1 / d, 100.0), 2); }},
    {"three", kThree, 4.47,
     [](double d, double r) { return std::pow(Window(d, r), 2) / std::max(d * d, 0.01); }},
    {"glTF", kGltf, 3.76, [](double d, double r) { return Window(d, r) / (d * d); }},
    {"Unreal", kUnreal, 4.47,
     [](double d, double r) {  // in centimetres, as the engine computes
       return 1e4 * std::pow(Window(d, r), 2) / (1e4 * d * d + 1.0);
     }},
    {"Godot", kGodot, 4.47, [](double d, double r) { return std::pow(Window(d, r), 2) / (d * d); }},
};

TEST(FalloffRefit, HalfAPercentOverTheReadingsAtTheRangeOfTheBar) {
  for (const Engine& engine : kEngines) {
    for (const std::vector<double>& distances :
         {std::vector<double>{0.25, 0.5, 1.0, 2.0}, {1.0}, {0.3, 8.0}, {0.5, 1.0, 1.5, 2.0, 3.0}}) {
      const double range = engine.ranges_of_farthest * std::ranges::max(distances);
      const FalloffRefit refit =
          RefitFalloff({.falloff = engine.law, .fixed = Metres(range)}, distances);
      EXPECT_EQ(refit.range.value(), range);
      double worst = 0.0;
      for (const double d : distances) {
        const double ratio = refit.intensity_factor * engine.lux_per_candela(d, range) * d * d;
        worst = std::max(worst, std::abs(ratio - 1.0));
      }
      EXPECT_LE(worst, 0.005) << engine.name;
      EXPECT_NEAR(worst, refit.residual, 1e-4) << engine.name;
    }
  }
}

TEST(FalloffRefit, WithoutAFixedRangeItIsRaisedUntilHalfAPercentIsLost) {
  const std::vector<double> distances = {100.0, 4000.0};
  const FalloffRefit far =
      RefitFalloff({.falloff = kGodot, .far_range = Metres(4096.0)}, distances);
  EXPECT_NEAR(far.range.value() / 4000.0, 4.47, 0.01);
  const FalloffRefit plain =
      RefitFalloff({.falloff = kGltf, .far_range = Metres(100.0)}, distances);
  EXPECT_NEAR(plain.range.value() / 4000.0, 3.76, 0.01);
  EXPECT_EQ(RefitFalloff({.falloff = kGodot, .far_range = Metres(4096.0)}, std::vector<double>{1.0})
                .range.value(),
            4096.0);
}

TEST(FalloffRefit, UnrealsSquareCentimetreIsGivenBackCloseToTheLamp) {
  const FalloffRefit refit = RefitFalloff({.falloff = kUnreal}, std::vector<double>{0.2});
  EXPECT_NEAR(refit.intensity_factor, 1.0 + 1e-4 / 0.04, 1e-9);
  EXPECT_NEAR(refit.residual, 0.0, 1e-12);
}

TEST(FalloffRefit, AShortRangeThatThePersonFixedIsWarnedWithTheOneThatWouldDo) {
  const LightFile file = FileOf({WarmPoint()});  // farthest reading 3 m, offset 6 cm, u 4 %
  Warnings warnings;
  const auto lights = PresetLightsFrom(file, {}, {}, warnings);
  ASSERT_TRUE(lights);
  const auto good =
      RefitLights(file, *lights, {.falloff = kGodot, .fixed = Metres(14.0)}, warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_LT(good[0].residual, 0.005);
  const auto bad = RefitLights(file, *lights, {.falloff = kGodot, .fixed = Metres(4.0)}, warnings);
  EXPECT_GT(bad[0].residual, 0.1);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "falloff_residual");
  EXPECT_THAT(warnings[0].message, ::testing::HasSubstr("13.7m"));
  const auto dark = RefitLights(file, *lights, {.falloff = kGodot, .fixed = Metres(2.0)}, warnings);
  EXPECT_EQ(dark[0].residual, 1.0);
  EXPECT_THAT(warnings.back().message, ::testing::HasSubstr("100 %"));
}

}  // namespace
}  // namespace lightcal::test
