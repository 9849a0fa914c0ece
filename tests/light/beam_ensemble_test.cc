// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/beam_ensemble.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lightcal {
namespace {

TEST(BeamEnsemble, EightHundredLumensInThirtySixDegreesGiveOneToThreeThousandCandela) {
  const auto beams = BeamEnsemble(RadiansFromDegrees(36.0), std::nullopt);
  ASSERT_TRUE(beams.has_value());
  // Uniform cone of 18 degrees half angle: 806/(2 pi (1 - cos 18 deg)) = 2621 cd.
  EXPECT_NEAR(806.0 / beams->least.value(), 2621.0, 1.0);
  // cos^n with n = ln .5/ln cos 18 deg = 13.81 and a third of the flux as spill: 1266 cd.
  EXPECT_NEAR(806.0 / beams->most.value(), 1266.0, 3.0);
}

TEST(BeamEnsemble, HoldsTheLambertianLampWhoseBeamIs120Degrees) {
  const auto beams = BeamEnsemble(RadiansFromDegrees(120.0), std::nullopt);
  ASSERT_TRUE(beams.has_value());
  EXPECT_LE(beams->least.value(), std::numbers::pi);
  EXPECT_GE(beams->most.value(), std::numbers::pi);
}

TEST(BeamEnsemble, AFieldAngleNarrowsTheAnswer) {
  const auto beam = BeamEnsemble(RadiansFromDegrees(36.0), std::nullopt);
  const auto both = BeamEnsemble(RadiansFromDegrees(36.0), RadiansFromDegrees(60.0));
  ASSERT_TRUE(beam && both);
  EXPECT_LT(both->most.value() / both->least.value(), beam->most.value() / beam->least.value());
  EXPECT_GT(both->least.value(), 0.25);
  EXPECT_LT(both->most.value(), 0.7);
}

TEST(BeamEnsemble, HoldsTheGaussianBeamWhoseFieldIsItsOwn) {
  // A Gaussian's field/beam ratio is sqrt(log2 10) = 1.8226.
  const double half = 0.2;
  double gaussian = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double t = (i + 0.5) * 0.5 * std::numbers::pi / 20000;
    gaussian += 2.0 * std::numbers::pi * std::sin(t) *
                std::exp(-std::numbers::ln2 * t * t / (half * half)) * 0.5 * std::numbers::pi /
                20000;
  }
  const auto beams =
      BeamEnsemble(Radians(2.0 * half), Radians(2.0 * half * std::sqrt(std::log2(10.0))));
  ASSERT_TRUE(beams.has_value());
  EXPECT_LE(beams->least.value(), gaussian * (1.0 + 1e-6));
  EXPECT_GE(beams->most.value(), gaussian * (1.0 - 1e-6));
}

// 2 pi int f sin over the hemisphere, by the midpoint rule.
double SolidAngleOf(const RelativeIntensity& beam) {
  constexpr int kSteps = 20000;
  const double h = 0.5 * std::numbers::pi / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += beam(Radians((i + 0.5) * h)) * std::sin((i + 0.5) * h);
  return 2.0 * std::numbers::pi * sum * h;
}

TEST(BeamEnsemble, ABeamDrawnHasTheAnglesAndTheFluxItWasToldOf) {
  for (const double deg : {10.0, 36.0, 60.0, 90.0, 120.0}) {
    const auto beams = BeamEnsemble(RadiansFromDegrees(deg), std::nullopt);
    const double middle = std::sqrt(beams->least.value() * beams->most.value());
    const auto beam = BeamOf(RadiansFromDegrees(deg), std::nullopt, Steradians(middle));
    ASSERT_TRUE(beam);
    EXPECT_NEAR((*beam)(Radians(0.0)), 1.0, 1e-12);
    EXPECT_NEAR((*beam)(RadiansFromDegrees(deg / 2.0)), 0.5, 1e-9) << deg;
    EXPECT_NEAR(SolidAngleOf(*beam) / middle, 1.0, 1e-4) << deg;
  }
  const auto both = BeamOf(RadiansFromDegrees(36.0), RadiansFromDegrees(60.0), Steradians(0.47));
  ASSERT_TRUE(both);
  EXPECT_NEAR((*both)(RadiansFromDegrees(18.0)), 0.5, 1e-9);
  EXPECT_NEAR((*both)(RadiansFromDegrees(30.0)), 0.1, 1e-9);
  EXPECT_FALSE(BeamOf(RadiansFromDegrees(36.0), RadiansFromDegrees(30.0), Steradians(0.4)));
}

TEST(BeamEnsemble, RefusesAFieldInsideTheBeam) {
  EXPECT_EQ(BeamEnsemble(RadiansFromDegrees(36.0), RadiansFromDegrees(30.0)).error().code,
            "bad_beam");
  EXPECT_EQ(BeamEnsemble(RadiansFromDegrees(0.0), std::nullopt).error().code, "bad_beam");
  EXPECT_EQ(BeamEnsemble(RadiansFromDegrees(179.0), std::nullopt).error().code, "bad_beam");
}

}  // namespace
}  // namespace lightcal
