// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "lightcal/light/effects/effect_table.h"
#include "lightcal/light/gate_ladder.h"
#include "lightcal/light/intensity_table.h"

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
  EXPECT_EQ(names.size(), 20U);
}

// On, off within the tolerance or not of the scene: an effect nobody states is never left out.
TEST(Gate, NothingAboveTheToleranceIsOffAndEveryEffectNamesItsKey) {
  for (const double tolerance : {0.003, 0.01, 0.1}) {
    for (const GatedEffect& effect : Gate(OneReading(), tolerance)) {
      EXPECT_FALSE(effect.key.empty()) << effect.name;
      if (effect.state != GateState::kOff) continue;
      EXPECT_TRUE(effect.ignored || !effect.finding.applies) << effect.name;
      EXPECT_LE(effect.finding.bound, tolerance) << effect.name;
    }
  }
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

TEST(Gate, AnUnknownRoomIsNamedWithTheCureAndWidens) {
  const GatedEffect bounce = Named(Gate(OneReading()), "room_bounce");
  EXPECT_EQ(bounce.state, GateState::kOn);
  EXPECT_FALSE(bounce.ignored);
  EXPECT_THAT(bounce.reason, HasSubstr("no [room] given"));
  EXPECT_THAT(bounce.reason, HasSubstr("shadow-card"));
}

TEST(Gate, AShadowCardTakesAmbientAwayAndTheBounceButForTheWallItHides) {
  Scene scene = OneReading();
  scene.room = RoomBox{{5, 4, 2.6}, 0.8};
  EXPECT_EQ(Named(Gate(scene), "room_bounce").state, GateState::kOn);
  scene.poses.front().differenced = true;
  const GatedEffect hidden = Named(Gate(scene), "room_bounce");
  EXPECT_EQ(hidden.state, GateState::kOn);
  EXPECT_LT(hidden.finding.bound, 0.06);
  EXPECT_LT(*hidden.finding.sd, 0.011);
  EXPECT_EQ(Named(Gate(scene), "ambient").finding.bound, 0.0);
  scene.no_walls = true;
  EXPECT_EQ(Named(Gate(scene), "room_bounce").finding.bound, 0.0);
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

TEST(Gate, AnEffectOfNoConcernIsNotApplicableEvenWhenAllAreOn) {
  for (const std::string_view overrides : {"auto", "all"}) {
    for (const std::string_view name :
         {"rolling_shutter", "vignetting", "veiling_glare", "table_interpolation"}) {
      const GatedEffect effect = Named(Gate(OneReading(), 0.01, overrides), name);
      EXPECT_FALSE(effect.finding.applies) << name;
      EXPECT_EQ(effect.state, GateState::kOff) << name;
      EXPECT_EQ(effect.finding.bound, 0.0) << name;
      EXPECT_THAT(effect.reason, HasSubstr("not applicable")) << name;
    }
  }
}

TEST(Gate, WhatIsLeftOffTogetherIsCompounded) {
  Scene scene = OneReading(1.0);
  scene.ambient_ratio = 0.04;
  scene.poses.front().tilt_rad = 0.2;
  const auto effects = Gate(scene, 0.1);
  double sum = 0.0;
  double kept = 1.0;
  for (const GatedEffect& effect : effects) {
    if (!effect.ignored) continue;
    sum += effect.finding.bound;
    kept *= 1.0 - effect.finding.bound;
  }
  EXPECT_DOUBLE_EQ(LeftOffTogether(effects), 1.0 / kept - 1.0);
  EXPECT_GT(LeftOffTogether(effects), sum);
  EXPECT_LE(LeftOffTogether(effects), 0.1);
}

TEST(Gate, AnEffectThatIsOnStaysOnUntilItsBoundIsWellBelow) {
  // A disk whose bound alone sits about a tolerance of 1 %; everything else far below.
  const auto at = [](double distance) {
    Scene scene = OneReading(distance);
    scene.kind = LightKind::kDisk;
    scene.size.diameter = Metres(0.2);
    scene.ambient_ratio = 0.0;
    scene.time.own_lamp = false;
    return scene;
  };
  const auto bound = [&](double distance) { return effects::FindFiniteSource(at(distance)).bound; };
  const double near = 1.0;     // 1 %: on
  const double little = 1.12;  // 0.8 %
  const double far = 1.35;     // 0.55 %
  ASSERT_NEAR(bound(little), 0.008, 1e-4);
  const auto on = Gate(at(near), 0.0112);
  ASSERT_EQ(Named(on, "finite_source").state, GateState::kOn);
  ASSERT_EQ(Named(Gate(at(little), 0.0112), "finite_source").state, GateState::kOff);
  auto after = RegateEffects(on, at(little), 0.0112, "auto");
  ASSERT_TRUE(after.has_value());
  EXPECT_EQ(Named(*after, "finite_source").state, GateState::kOn);
  EXPECT_FALSE(OutgrewShare(on, *after));
  after = RegateEffects(on, at(far), 0.0112, "auto");
  ASSERT_TRUE(after.has_value());
  EXPECT_EQ(Named(*after, "finite_source").state, GateState::kOff);
  const auto off = Gate(at(far), 0.0112);
  after = RegateEffects(off, at(near), 0.0112, "auto");
  ASSERT_TRUE(after.has_value());
  EXPECT_TRUE(OutgrewShare(off, *after));
}

// The errors of the ladder are against brute force; what the gate leaves off changes the answer of
// every effect by no more than it says.
TEST(GateLadder, NoAnswerIsTheTruthAndTheGateKeepsWithinItsBoundOfEveryEffect) {
  for (const NamedScene& named : LadderScenes()) {
    for (const double tolerance : {0.003, 0.01, 0.1}) {
      const GateStep step = StepOf(named, tolerance);
      EXPECT_GT(step.error_all, 0.0) << named.name;
      EXPECT_LT(step.error_all, 0.12) << named.name;
      EXPECT_LE(std::abs(step.error_gate - step.error_all), step.bound * 1.2 + 1e-12) << named.name;
      EXPECT_LE(step.cost_gate_ns, step.cost_all_ns) << named.name;
    }
  }
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

TEST(Effects, OffItsAxisASourcesSizeStaysWithinItsBound) {
  // Disk that shines as cos^n (n = 1 is Lambertian) and rectangle by midpoint sums, a facing meter.
  const auto mean = [](double half_w, double half_h, bool disk, double n, const ScenePose& pose) {
    const double s = std::sin(pose.emission_rad);
    const double c = std::cos(pose.emission_rad);
    const double d = pose.distance_m;
    constexpr int kSteps = 80;
    double sum = 0.0;
    double area = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        double x = half_w * (2.0 * (i + 0.5) / kSteps - 1.0);
        double y = half_h * (2.0 * (j + 0.5) / kSteps - 1.0);
        if (disk && x * x + y * y > half_w * half_w) continue;
        const double vx = d * s - x, vy = -y, vz = d * c;
        const double r = std::sqrt(vx * vx + vy * vy + vz * vz);
        sum += std::pow(vz / r, n) * (vx * s + vz * c) / (r * r * r);
        area += 1.0;
      }
    }
    return sum / area / (std::pow(c, n) / (d * d)) - 1.0;
  };
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 120; ++i) {
    Scene scene = OneReading(0.5 * std::pow(6.0, uniform(random)));
    scene.poses.front().emission_rad = 0.01 + 0.9 * uniform(random);
    const double half = 0.02 + 0.1 * uniform(random);
    const double other = 0.02 + 0.1 * uniform(random);
    const ScenePose& pose = scene.poses.front();
    scene.kind = LightKind::kDisk;
    scene.size.diameter = Metres(2.0 * half);
    EXPECT_LE(std::abs(mean(half, half, true, 1.0, pose)),
              effects::FindFiniteSource(scene).bound + 2e-4);
    const double beam_deg = 15.0 + 90.0 * uniform(random);
    scene.beam = RadiansFromDegrees(beam_deg);
    const double n = effects::BeamExponent(RadiansFromDegrees(0.5 * beam_deg).value());
    if (pose.emission_rad < RadiansFromDegrees(0.5 * beam_deg).value()) {
      EXPECT_LE(std::abs(mean(half, half, true, n, pose)),
                effects::FindNarrowBeam(scene).bound + 2e-4)
          << n << " " << half / pose.distance_m << " " << pose.emission_rad;
    }
    scene.kind = LightKind::kRect;
    scene.size = {};
    scene.size.width = Metres(2.0 * half);
    scene.size.height = Metres(2.0 * other);
    EXPECT_LE(std::abs(mean(half, other, false, 1.0, pose)),
              effects::FindFiniteSource(scene).bound + 2e-4);
  }
}

TEST(Effects, FlickerBoundsPulsesAndRipplesAtEveryPhase) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 200; ++i) {
    SceneTime time;
    time.flicker_hz = 50.0 * std::pow(40.0, uniform(random));
    const double window = 1e-3 * std::pow(500.0, uniform(random));
    const double part = 0.05 + 0.9 * uniform(random);
    const double begin = uniform(random) / *time.flicker_hz;
    const bool pulses = i % 2 == 0;
    (pulses ? time.duty : time.ripple) = part;
    constexpr int kSteps = 40000;
    double sum = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double phase = *time.flicker_hz * (begin + window * (k + 0.5) / kSteps);
      const double whole = phase - std::floor(phase);
      sum += pulses ? (whole < part ? 1.0 / part : 0.0)
                    : 1.0 + part * std::sin(2.0 * std::numbers::pi * phase);
    }
    EXPECT_LE(std::abs(sum / kSteps - 1.0), effects::FlickerBound(time, window) + 2e-3);
  }
}

TEST(Effects, ARollingShutterAveragesOverItsRows) {
  Scene scene = OneReading();
  scene.picture.emplace();
  scene.picture->exposure_s = 1e-3;
  scene.time.duty = 0.5;
  scene.picture->rows_s = 0.02;
  const double banded = effects::FindRollingShutter(scene).bound;
  EXPECT_NEAR(banded, 0.5 / (100.0 * 0.02), 1e-12);
  EXPECT_FALSE(effects::FindFlicker(scene).applies);  // counted once
  scene.picture->rows_s = 0.0;
  EXPECT_LT(banded, effects::FindFlicker(scene).bound);
  EXPECT_FALSE(effects::FindRollingShutter(scene).applies);
}

TEST(Effects, WarmUpIsTheDriftLeftAndADefaultWhereNobodySays) {
  Scene scene = OneReading();
  EXPECT_NEAR(effects::FindWarmUp(scene).bound, 0.2 * std::exp(-2.0), 1e-12);
  EXPECT_EQ(effects::FindWarmUp(scene).treatment, Treatment::kWidens);
  scene.time.on_for_s = 3600.0;
  EXPECT_NEAR(effects::FindWarmUp(scene).bound, 0.2 * std::exp(-4.0), 1e-12);
  scene.time.own_lamp = false;
  EXPECT_FALSE(effects::FindWarmUp(scene).applies);
}

// E over E0 cos(tilt) of a disk that shines evenly, by a million pieces; the meter on its axis is
// tilted towards `way`, and what lies behind its plane is not seen.
double CutOfDisk(double radius, double distance, double tilt) {
  constexpr int kRings = 1000, kParts = 1000;
  double seen = 0.0, facing = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double r = (i + 0.5) / kRings * radius;
    for (int k = 0; k < kParts; ++k) {
      const double x = r * std::cos(2.0 * std::numbers::pi * (k + 0.5) / kParts);
      const double l2 = r * r + distance * distance;
      const double weight = r * distance / (l2 * l2);  // of the piece, seen along its way
      facing += weight * distance;
      seen += weight * std::max(0.0, distance * std::cos(tilt) - x * std::sin(tilt));
    }
  }
  return seen / (facing * std::cos(tilt));
}

TEST(Effects, TheHorizonCutsWhatLiesBehindATiltedMeter) {
  for (const auto& [distance, degrees] : {std::pair(0.5, 60.0), std::pair(0.3, 45.0)}) {
    Scene scene = OneReading(distance);
    scene.kind = LightKind::kDisk;
    scene.size.diameter = Metres(1.2);
    scene.poses.front().tilt_rad = RadiansFromDegrees(degrees).value();
    const double cut = CutOfDisk(0.6, distance, scene.poses.front().tilt_rad) - 1.0;
    EXPECT_NEAR(effects::FindHorizon(scene).bound, cut, 1e-3 + 0.01 * cut);
    EXPECT_GT(cut, 0.005);
  }
}

TEST(Effects, HorizonIsATestOfTheSourcesRadius) {
  Scene scene = OneReading(1.0);
  scene.kind = LightKind::kDisk;
  scene.size.diameter = Metres(0.2);
  EXPECT_EQ(effects::FindHorizon(scene).bound, 0.0);
  scene.poses.front().tilt_rad = RadiansFromDegrees(85.0).value();
  EXPECT_GT(effects::FindHorizon(scene).bound, 0.0);
  EXPECT_LT(effects::FindHorizon(scene).bound, 0.01);
  // Facing a softbox squarely a meter sees all of it, however near; within a ball of that radius it
  // would not.
  scene.poses.front().tilt_rad = 0.0;
  scene.size.diameter = Metres(2.4);
  EXPECT_EQ(effects::FindHorizon(scene).bound, 0.0);
  scene.kind = LightKind::kSphere;
  EXPECT_EQ(effects::FindHorizon(scene).bound, 1.0);
}

TEST(Effects, TableInterpolationBoundsSmoothLobesBetweenTheirNodes) {
  for (const double n : {1.0, 4.0, 12.0, 30.0}) {
    for (const double step : {1.0, 2.5, 5.0, 10.0}) {
      IntensityGrid grid{GoniometerType::kC, {0.0}, {}, {}};
      const auto lobe = [n](double degrees) {
        return std::pow(std::max(0.0, std::cos(RadiansFromDegrees(degrees).value())), n);
      };
      for (int i = 0; step * i <= 90.0; ++i) {
        grid.vertical_deg.push_back(step * i);
        grid.candela.push_back(100.0 * lobe(step * i));
      }
      const auto table = IntensityTable::Make(grid, "lobe");
      ASSERT_TRUE(table.has_value());
      Scene scene = OneReading();
      scene.table_step_rad = table->LargestStep().value();
      EXPECT_NEAR(*scene.table_step_rad, RadiansFromDegrees(step).value(), 1e-12);
      int within = 0;
      int directions = 0;
      for (double degrees = 0.05; degrees < 75.0; degrees += 0.1, ++directions) {
        const Radians gamma = RadiansFromDegrees(degrees);
        const double between = table->At(Radians(0.0), gamma).value();
        scene.poses.front().table_error =
            table->InterpolationErrorAt(Radians(0.0), gamma).value() / between;
        const double error = std::abs(between / (100.0 * lobe(degrees)) - 1.0);
        within += error <= effects::FindTableInterpolation(scene).bound + 1e-4 ? 1 : 0;
      }
      EXPECT_GE(within, 0.98 * directions) << n << ", nodes " << step;
    }
  }
}

TEST(Effects, BetweenPlanesTheTableIsAsUnsureAsTheyAreFarApart) {
  // 1 + cos C, which planes a right angle apart cannot tell: at 45 degrees .207 of it is missing.
  const IntensityGrid grid{
      GoniometerType::kC,
      {0.0, 90.0, 180.0, 270.0},
      {0.0, 30.0, 60.0, 90.0},
      {1.5, 2.0, 2.0, 2.0, 1.5, 1.0, 1.0, 1.0, 1.5, 1e-3, 1e-3, 1e-3, 1.5, 1.0, 1.0, 1.0}};
  const auto table = IntensityTable::Make(grid, "planes");
  ASSERT_TRUE(table.has_value());
  const Radians gamma = RadiansFromDegrees(60.0);
  const Radians between = RadiansFromDegrees(45.0);
  const double error = 1.0 + std::cos(between.value()) - table->At(between, gamma).value();
  EXPECT_NEAR(error, 0.207, 1e-3);
  EXPECT_LE(error, 2.2 * table->InterpolationErrorAt(between, gamma).value());
  EXPECT_EQ(table->InterpolationErrorAt(RadiansFromDegrees(90.0), gamma).value(), 0.0);
}

TEST(Effects, PicturesHaveVignettingAndGlare) {
  Scene scene = OneReading();
  scene.picture.emplace();
  EXPECT_GE(effects::FindVignetting(scene).bound,
            1.0 - std::pow(std::cos(effects::kFieldDefault_rad), 4.0));
  scene.picture->glare = 0.02;
  scene.picture->mean_over_patch = 0.5;
  EXPECT_NEAR(effects::FindVeilingGlare(scene).bound, 0.01, 1e-12);
  scene.picture->flat_field = true;
  EXPECT_FALSE(effects::FindVignetting(scene).applies);
  // A fisheye's rim: a lamp cannot read lower than by all of itself.
  scene.picture->flat_field = false;
  scene.picture->off_middle_rad = 1.22;
  EXPECT_NEAR(effects::FindVignetting(scene).bound, 1.0 - std::pow(std::cos(1.22), 4.0), 1e-12);
  scene.picture->off_middle_rad = 3.0;
  EXPECT_DOUBLE_EQ(effects::FindVignetting(scene).bound, 1.0);
}

}  // namespace
}  // namespace lightcal
