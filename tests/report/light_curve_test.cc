// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/light_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_lights.h"

namespace lightcal {
namespace {

TEST(LightCurve, IsTheFittedLaw) {
  const auto curve = LightCurve::Of(test::WarmPoint());
  ASSERT_TRUE(curve.has_value());
  EXPECT_NEAR(curve->LuxAt(0.94), 1000.0 + 1.5, 1e-9);  // (0.94 + 0.06) = 1 m
}

// Var(ln E) of a pure inverse-square law with independent ln I and d0: s1^2 + (2 s2/r)^2.
TEST(LightCurve, TheBandPropagatesIntensityAndOffset) {
  FittedLight light = test::WarmPoint();
  light.ambient_lx.reset();
  light.covariance_lnI_d0_E0 = {4e-4, 0, 0, 0, 1e-4, 0, 0, 0, 0};
  const auto curve = LightCurve::Of(light);
  for (const double d : {0.2, 0.44, 1.94}) {
    const double r = d + 0.06;
    EXPECT_NEAR(*curve->SdOfLogAt(d), std::sqrt(4e-4 + 4.0 * 1e-4 / (r * r)), 1e-7);
  }
}

TEST(LightCurve, ADiskIsWeakerNearByWhenTheGateSaysSo) {
  FittedLight disk = test::SimpleLight("disk", LightKind::kDisk, 100.0);
  disk.diameter_m = 0.4;
  EXPECT_NEAR(LightCurve::Of(disk)->LuxAt(0.2), 100.0 / 0.04, 1e-9);
  disk.effects = {{"finite_source", EffectState::kOn, 0.5, 0.5, 1.0, ""}};
  EXPECT_NEAR(LightCurve::Of(disk)->LuxAt(0.2), 100.0 / (0.04 + 0.04), 1e-9);
}

TEST(LightCurve, AGlobesRadiusIsCountedOnce) {
  FittedLight globe = test::SimpleLight("globe", LightKind::kSphere, 60.0);
  globe.diameter_m = 0.4;
  globe.distance_offset_m = Uncertain{0.2, 0.02, {}, {}};
  globe.effects = {{"sphere_surface", EffectState::kFitted, 0.4, 0.2, 0.5, ""}};
  EXPECT_NEAR(LightCurve::Of(globe)->LuxAt(1.0), 60.0 / 1.44, 1e-9);
  globe.distance_offset_m->value = 0.0;
  globe.effects.front().state = EffectState::kOn;
  EXPECT_NEAR(LightCurve::Of(globe)->LuxAt(1.0), 60.0 / 1.44, 1e-9);
}

TEST(LightCurve, ALightAtInfinityHasNone) { EXPECT_FALSE(LightCurve::Of(test::Sun()).has_value()); }

}  // namespace
}  // namespace lightcal
