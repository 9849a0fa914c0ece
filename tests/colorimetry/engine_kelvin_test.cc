// SPDX-License-Identifier: Apache-2.0
// Truth: the exact locus, and values measured in the engines themselves.
#include "lightcal/colorimetry/engine_kelvin.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightcal {
namespace {

TEST(KrystekUv, StaysWithinItsPublishedErrorOfTheLocus) {
  double worst = 0.0;
  for (double kelvin = 1000.0; kelvin <= 15'000.0; kelvin += 50.0) {
    const Uv1960 exact = UvFromCct(Kelvin(kelvin));
    const Uv1960 fit = KrystekUv(Kelvin(kelvin));
    worst = std::max(worst, std::abs(CctFromUv(fit).duv));
    EXPECT_LT(std::hypot(fit.u - exact.u, fit.v - exact.v), 3e-4) << kelvin;
  }
  EXPECT_LT(worst, 1.34e-4);
  EXPECT_GT(worst, 1.2e-4);
  EXPECT_NEAR(CctFromUv(KrystekUv(Kelvin(6500))).temperature.value(), 6500.0, 0.5);
  EXPECT_NEAR(std::abs(CctFromUv(KrystekUv(Kelvin(15000))).temperature.value() - 15000.0), 74.0,
              1.0);
}

TEST(GodotColor, EqualsWhatGodotRenders) {  // measured: 2700 K, and its default of 6500 K
  const Rgb warm = KrystekRgbAtUnitPeak(Kelvin(2700));
  EXPECT_DOUBLE_EQ(warm.r, 1.0);
  EXPECT_NEAR(warm.g, 0.4159, 1e-4);
  EXPECT_NEAR(warm.b, 0.0984, 1e-4);
  const Rgb neutral = KrystekRgbAtUnitPeak(Kelvin(6500));
  EXPECT_NEAR(neutral.g, 0.942, 1e-3);
  EXPECT_NEAR(neutral.b, 0.992, 1e-3);
}

TEST(UnrealColor, HasUnitLuminanceAndIsClampedAtBothEnds) {
  for (const double kelvin : {1850.0, 3200.0, 6500.0, 15'000.0}) {
    const Rgb c = KrystekRgbAtUnitY(Kelvin(kelvin));
    EXPECT_NEAR(LuminanceOfRgb(c, RgbSpace::kSrgb), 1.0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(KrystekRgbAtUnitY(Kelvin(40'000)).r, KrystekRgbAtUnitY(Kelvin(15'000)).r);
  EXPECT_DOUBLE_EQ(KrystekRgbAtUnitY(Kelvin(500)).r, KrystekRgbAtUnitY(Kelvin(1000)).r);
}

TEST(UnitLuminanceColor, EqualsBlendersBlackbodyNode) {  // rendered at 2700 K in 3.4 and 5.2
  const Rgb c = PlanckianRgbAtUnitY(Kelvin(2700));
  EXPECT_NEAR(c.r, 1.935, 3e-3);
  EXPECT_NEAR(c.g, 0.8035, 3e-3);
  EXPECT_NEAR(c.b, 0.192, 3e-3);
}

TEST(KrystekKelvin, ReturnsTheSettingThatMadeTheColor) {
  for (const double kelvin : {1100.0, 2700.0, 6500.0, 14'000.0}) {
    const auto found = KrystekKelvinFrom(KrystekUv(Kelvin(kelvin)));
    ASSERT_TRUE(found) << kelvin;
    EXPECT_NEAR(found->value(), kelvin, kelvin * 1e-5);
  }
  EXPECT_FALSE(KrystekKelvinFrom(UvFromCct(Kelvin(30'000))));
}

TEST(AdobeReadout, IsRobertsonsTemperatureAndMinusThreeThousandTimesDuv) {
  for (const double kelvin : {2000.0, 2856.0, 3102.0, 5003.0, 9000.0}) {
    for (const double duv : {-0.005, 0.0, 0.005}) {
      const auto readout = AdobeReadoutFrom(UvFromCct(Kelvin(kelvin), duv));
      ASSERT_TRUE(readout);
      EXPECT_NEAR(readout->temperature.value() / kelvin, 1.0, 1e-3) << kelvin << " " << duv;
      EXPECT_NEAR(readout->tint, -3000.0 * duv, 0.5) << kelvin << " " << duv;
    }
  }
  EXPECT_FALSE(AdobeReadoutFrom(UvFromCct(Kelvin(1500))));
}

}  // namespace
}  // namespace lightcal
