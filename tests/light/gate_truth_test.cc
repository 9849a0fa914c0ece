// SPDX-License-Identifier: Apache-2.0
// The gate and the bounce's bound against simulators that share nothing with them. More scenes and
// rooms by LIGHTCAL_GATE_SCENES and LIGHTCAL_BOUNCE_ROOMS (tests/bench/gate_nightly).
#include "gate_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "lightcal/light/gate.h"
#include "lightcal/light/room_bounce.h"
#include "trials.h"

namespace lightcal {
namespace {

int CountFrom(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::max(1, std::atoi(text)) : otherwise;
}

double Quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * (static_cast<double>(values.size()) - 1.0))];
}

// What a session would say of it.
Scene Stated(const test::TruthScene& truth, double ambient_ratio) {
  Scene scene;
  scene.kind = LightKind::kDisk;
  scene.size.diameter = Metres(2.0 * truth.radius_m);
  scene.beam = Radians(truth.beam_rad);
  scene.position_m = Vec3{truth.lamp[0], truth.lamp[1], truth.lamp[2]};
  scene.aim = Vec3{truth.aim[0], truth.aim[1], truth.aim[2]};
  ScenePose pose;
  pose.distance_m = truth.distance_m;
  pose.tilt_rad = truth.tilt_rad;
  pose.position_m = Vec3{truth.meter[0], truth.meter[1], truth.meter[2]};
  pose.emission_rad = truth.emission_rad;
  scene.poses.push_back(pose);
  scene.room =
      RoomBox{{truth.box.size[0], truth.box.size[1], truth.box.size[2]}, truth.box.reflectance};
  scene.ambient_ratio = ambient_ratio;
  scene.head_radius = Metres(truth.head_radius_m);
  scene.time.flicker_hz = truth.flicker_hz;
  scene.time.duty = truth.duty;
  scene.time.window_s = truth.window_s;
  scene.time.on_for_s = truth.on_for_s;
  scene.time.filament = true;
  scene.time.haze_per_metre = truth.haze_per_metre;
  // Nothing of the meter's own response: truth has a perfect one.
  scene.spectral_f1 = 0.0;
  scene.cosine_f2 = 0.0;
  return scene;
}

struct Tally {
  int violations = 0;
  std::vector<double> slack;  // bound of what is off / its true error
  std::vector<double> error;  // over the tolerance
  double off = 0.0;           // effects of the eleven, summed
};

void Judge(const test::TruthScene& truth, const test::TruthParts& parts, double tolerance,
           Tally& tally) {
  const double all = test::Illuminance(truth, parts, test::kAllTruthEffects);
  const Scene scene = Stated(truth, truth.ambient_over_direct * parts.point / all);
  const auto effects = GateEffects(scene, tolerance, "auto");
  ASSERT_TRUE(effects.has_value());
  unsigned on = test::kAllTruthEffects;
  for (std::size_t i = 0; i < test::kTruthEffects.size(); ++i) {
    const auto effect = std::find_if(effects->begin(), effects->end(), [&](const GatedEffect& e) {
      return e.name == test::kTruthEffects[i];
    });
    ASSERT_NE(effect, effects->end()) << test::kTruthEffects[i];
    if (!effect->ignored) continue;
    on &= ~(1U << i);
    tally.off += 1.0;
  }
  const double error = std::abs(test::Illuminance(truth, parts, on) / all - 1.0);
  if (error > tolerance) ++tally.violations;
  tally.error.push_back(error / tolerance);
  if (on != test::kAllTruthEffects) tally.slack.push_back(LeftOffTogether(*effects) / error);
}

TEST(GateAgainstTruth, WhatIsLeftOffNeverBreaksTheTolerance) {
  constexpr std::array kTolerances = {0.005, 0.01, 0.02, 0.05, 0.1};
  const int scenes = CountFrom("LIGHTCAL_GATE_SCENES", 700);
  std::mt19937_64 random(20261121);
  std::array<Tally, kTolerances.size()> tallies;
  for (int i = 0; i < scenes; ++i) {
    const test::TruthScene truth = test::RandomTruthScene(random);
    const test::TruthParts parts = test::BruteForce(truth);
    for (std::size_t k = 0; k < kTolerances.size(); ++k) {
      Judge(truth, parts, kTolerances[k], tallies[k]);
    }
  }
  std::printf("%d scenes, 11 effects true in each\n", scenes);
  std::printf("tolerance  violations  off of 11  error/tolerance p50 p95   bound/error p50\n");
  for (std::size_t k = 0; k < kTolerances.size(); ++k) {
    const Tally& tally = tallies[k];
    std::printf("%8.1f %% %11d %10.2f %16.2f %8.2f %13.2f\n", 100.0 * kTolerances[k],
                tally.violations, tally.off / scenes, Quantile(tally.error, 0.5),
                Quantile(tally.error, 0.95), Quantile(tally.slack, 0.5));
    EXPECT_EQ(tally.violations, 0) << kTolerances[k];
    EXPECT_LE(Quantile(tally.slack, 0.5), 5.0) << kTolerances[k];
  }
  EXPECT_GE(tallies[1].off / scenes, 3.0);
}

// A room's answer by radiosity against the bound, for even lamps, Lambertian ones and beams.
struct RoomTally {
  int rooms = 0;
  int violations = 0;
  std::vector<double> slack;     // bound / solved
  std::vector<double> estimate;  // estimate / solved - 1
};

void JudgeRoom(std::mt19937_64& random, int kind, RoomTally& tally) {
  const test::TruthScene truth = test::RandomTruthScene(random);
  Scene scene = Stated(truth, 0.0);
  test::PointLamp lamp{truth.lamp, truth.aim, 0.0};
  if (kind == 0) scene.kind = LightKind::kPoint;
  if (kind != 2) scene.beam.reset();
  if (kind == 1) lamp.exponent = 1.0;
  if (kind == 2) lamp.exponent = std::log(0.5) / std::log(std::cos(0.5 * truth.beam_rad));
  test::Place normal{};
  for (int k = 0; k < 3; ++k) normal[k] = (truth.lamp[k] - truth.meter[k]) / truth.distance_m;
  ScenePose facing = scene.poses.front();
  facing.tilt_rad = 0.0;
  const double solved = test::IndirectIlluminance(truth.box, lamp, truth.meter, normal, {10, 120});
  const double direct =
      std::pow(std::cos(truth.emission_rad), lamp.exponent) / (truth.distance_m * truth.distance_m);
  const Bounce bounce = BounceAt(scene, facing);
  const double bound = bounce.RelativeBound(facing) * direct;
  ++tally.rooms;
  if (solved > bound) ++tally.violations;
  tally.slack.push_back(bound / solved);
  tally.estimate.push_back(bounce.Estimate() / solved - 1.0);
}

TEST(GateAgainstTruth, TheBouncesBoundHoldsAgainstRadiosity) {
  const int rooms = CountFrom("LIGHTCAL_BOUNCE_ROOMS", test::TrialsOf(60));
  constexpr std::array kNames = {"even lamps", "Lambertian", "beams"};
  std::mt19937_64 random(20261122);
  std::array<RoomTally, 3> tallies;
  for (int i = 0; i < rooms; ++i) {
    for (int kind = 0; kind < 3; ++kind) {
      JudgeRoom(random, kind, tallies[static_cast<std::size_t>(kind)]);
    }
  }
  int violations = 0;
  for (std::size_t kind = 0; kind < tallies.size(); ++kind) {
    const RoomTally& tally = tallies[kind];
    violations += tally.violations;
    std::printf(
        "%-11s %d rooms: %d violations, bound/solved p50 %.2f p95 %.2f, estimate %+.0f to "
        "%+.0f %% (p5 to p95)\n",
        kNames[kind], tally.rooms, tally.violations, Quantile(tally.slack, 0.5),
        Quantile(tally.slack, 0.95), 100.0 * Quantile(tally.estimate, 0.05),
        100.0 * Quantile(tally.estimate, 0.95));
  }
  EXPECT_LE(violations, 0.005 * 3 * rooms);
  EXPECT_LE(Quantile(tallies[0].slack, 0.5), 1.5);
}

}  // namespace
}  // namespace lightcal
