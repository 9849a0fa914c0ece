// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "lightcal/light/effects/effect_table.h"

namespace lightcal {
namespace {

using testing::HasSubstr;

Scene OneReading(double distance_m = 0.5) {
  Scene scene;
  scene.poses.push_back({distance_m, 0.0, false, false, std::nullopt});
  return scene;
}

std::vector<GatedEffect> Gate(const Scene& scene, double tolerance = 0.01,
                              std::string_view overrides = "auto") {
  auto effects = GateEffects(scene, tolerance, overrides);
  EXPECT_TRUE(effects.has_value());
  return *effects;
}
const GatedEffect& Named(const std::vector<GatedEffect>& effects, std::string_view name) {
  return *std::find_if(effects.begin(), effects.end(),
                       [&](const GatedEffect& e) { return e.name == name; });
}

TEST(Gate, NamesEveryEffectOnceWithAPriceAndAReason) {
  std::set<std::string_view> names;
  for (const GatedEffect& effect : Gate(OneReading())) {
    EXPECT_TRUE(names.insert(effect.name).second);
    EXPECT_GT(effect.cost_ns, 0.0);
    EXPECT_FALSE(effect.reason.empty());
    EXPECT_GE(effect.finding.bound, 0.0);
  }
  EXPECT_EQ(names.size(), 13U);
}

TEST(Gate, BoundsLeftOffTogetherStayWithinTheTolerance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 500; ++i) {
    Scene scene = OneReading(0.2 + 4.0 * uniform(random));
    scene.kind = LightKind::kDisk;
    scene.size.diameter = Metres(0.5 * uniform(random));
    scene.poses.front().tilt_rad = uniform(random);
    if (i % 2 == 0) scene.room = RoomBox{{5, 4, 2.6}, 0.5};
    if (i % 3 == 0) scene.head_radius = Metres(0.05 * uniform(random));
    const double tolerance = 0.1 * uniform(random);
    double off = 0.0;
    for (const GatedEffect& effect : Gate(scene, tolerance)) {
      if (effect.ignored) off += effect.finding.bound;
    }
    EXPECT_LE(off, tolerance);
  }
}

TEST(Gate, ALooserToleranceSwitchesNothingOn) {
  Scene scene = OneReading();
  scene.kind = LightKind::kDisk;
  scene.size.diameter = Metres(0.1);
  scene.poses.front().tilt_rad = 0.3;
  int last = 100;
  for (const double tolerance : {0.001, 0.005, 0.02, 0.05, 0.2, 1.0}) {
    const auto effects = Gate(scene, tolerance);
    const auto on = static_cast<int>(std::count_if(
        effects.begin(), effects.end(), [](const auto& e) { return e.state != GateState::kOff; }));
    EXPECT_LE(on, last);
    last = on;
  }
  EXPECT_LT(last, 3);
}

TEST(Gate, ALargeDiskNearByIsModelledAndFarAwayIsNot) {
  Scene scene = OneReading(1.0);
  scene.kind = LightKind::kDisk;
  scene.size.diameter = Metres(0.5);
  EXPECT_EQ(Named(Gate(scene), "finite_source").state, GateState::kOn);
  EXPECT_NEAR(Named(Gate(scene), "finite_source").finding.bound, 0.0625, 1e-12);
  scene.poses.front().distance_m = 20.0;
  EXPECT_EQ(Named(Gate(scene), "finite_source").state, GateState::kOff);
}

TEST(Gate, AnUnknownRoomIsNamedWithTheCure) {
  const GatedEffect bounce = Named(Gate(OneReading()), "room_bounce");
  EXPECT_EQ(bounce.state, GateState::kOff);
  EXPECT_FALSE(bounce.ignored);
  EXPECT_THAT(bounce.reason, HasSubstr("no [room] given"));
  EXPECT_THAT(bounce.reason, HasSubstr("shadow-card"));
}

TEST(Gate, AShadowCardTakesBounceAndAmbientAway) {
  Scene scene = OneReading();
  scene.room = RoomBox{{5, 4, 2.6}, 0.8};
  EXPECT_EQ(Named(Gate(scene), "room_bounce").state, GateState::kOn);
  scene.poses.front().differenced = true;
  EXPECT_EQ(Named(Gate(scene), "room_bounce").finding.bound, 0.0);
  EXPECT_EQ(Named(Gate(scene), "ambient").finding.bound, 0.0);
}

TEST(Gate, OverridesSwitchByName) {
  EXPECT_EQ(Named(Gate(OneReading(), 0.01, "+haze,-distance_offset"), "haze").state,
            GateState::kOn);
  EXPECT_EQ(Named(Gate(OneReading(), 0.01, "+haze,-distance_offset"), "distance_offset").state,
            GateState::kOff);
  for (const GatedEffect& effect : Gate(OneReading(), 0.01, "none")) {
    EXPECT_EQ(effect.state, GateState::kOff);
  }
  EXPECT_NE(Named(Gate(OneReading(), 0.01, "all"), "detector_size").state, GateState::kOff);
}

TEST(Gate, AnUnknownNameIsAnErrorThatNamesTheNearest) {
  const auto effects = GateEffects(OneReading(), 0.01, "+room_bounse");
  ASSERT_FALSE(effects.has_value());
  EXPECT_EQ(effects.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(effects.error().message, HasSubstr("room_bounce"));
}

TEST(Effects, DistanceErrorBoundsWhatFiveMillimetresDo) {
  const EffectFinding finding = effects::FindDistanceError(OneReading(0.5));
  for (const double slip : {-0.005, -0.002, 0.003, 0.005}) {
    const double ratio = 0.5 / (0.5 + slip);
    EXPECT_LE(std::abs(ratio * ratio - 1.0), finding.bound * (1.0 + 1e-12));
  }
}

TEST(Effects, MeterTiltBoundsWhatPointingDoes) {
  for (const double tilt : {0.0, 0.3, 0.8, 1.2}) {
    Scene scene = OneReading();
    scene.poses.front().tilt_rad = tilt;
    const double bound = effects::FindMeterTilt(scene).bound - (1.0 - std::cos(tilt));
    const double delta = RadiansFromDegrees(effects::kPointingDegrees).value();
    for (const double error : {-delta, -0.5 * delta, 0.5 * delta, delta}) {
      EXPECT_LE(std::abs(std::cos(tilt + error) / std::cos(tilt) - 1.0), bound * (1 + 1e-12));
    }
  }
}

TEST(Effects, SphereSurfaceBoundIsTwelvePercentForASixCentimetreGlobeAtHalfAMetre) {
  Scene scene = OneReading(0.5);
  scene.kind = LightKind::kSphere;
  scene.size.diameter = Metres(0.06);
  EXPECT_NEAR(effects::FindSphereSurface(scene).bound, 0.1236, 1e-4);
  scene.poses.front().from_center = true;
  EXPECT_EQ(effects::FindSphereSurface(scene).bound, 0.0);
}

TEST(Effects, DetectorFactorIsTheMeanOverTheHead) {
  // Mean of cos/r^2 over a disk of radius rho at distance d by rings.
  const double rho = 0.05;
  const double d = 0.2;
  double mean = 0.0;
  constexpr int kRings = 100000;
  for (int i = 0; i < kRings; ++i) {
    const double a = rho * (i + 0.5) / kRings;
    mean += d / std::pow(d * d + a * a, 1.5) * 2.0 * a * (rho / kRings) / (rho * rho);
  }
  EXPECT_NEAR(effects::DetectorFactor(rho, d), mean * d * d, 1e-9);
  Scene scene = OneReading(d);
  scene.head_radius = Metres(rho);
  EXPECT_LE(1.0 - effects::DetectorFactor(rho, d), effects::FindDetectorSize(scene).bound);
}

TEST(Effects, NarrowBeamBoundsTheExactDisk) {
  // Beam cos^n of a disk: true/point = 2/((n+1) y) (1 - (1+y)^(-(n+1)/2)), y = (R/d)^2.
  for (const double beam_deg : {20.0, 36.0, 60.0, 100.0}) {
    Scene scene = OneReading(1.0);
    scene.kind = LightKind::kSpot;
    scene.beam = RadiansFromDegrees(beam_deg);
    scene.size.diameter = Metres(0.1);
    const double n = effects::BeamExponent(RadiansFromDegrees(0.5 * beam_deg).value());
    const double y = 0.05 * 0.05;
    const double exact = -2.0 / ((n + 1.0) * y) * std::expm1(-0.5 * (n + 1.0) * std::log1p(y));
    EXPECT_LE(std::abs(exact - 1.0), effects::FindNarrowBeam(scene).bound);
    EXPECT_GE(std::abs(exact - 1.0), 0.4 * effects::FindNarrowBeam(scene).bound);
  }
}

}  // namespace
}  // namespace lightcal
