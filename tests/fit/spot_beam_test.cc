// SPDX-License-Identifier: Apache-2.0
// A spot's intensity, cone and aim from twelve meters on the floor.
#include "lightcal/fit/beam/spot_beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "area_twin.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/photometry/spot_cone.h"
#include "trials.h"

namespace lightcal {
namespace {

using test::AreaTwin;
using test::Pose;

// A lamp under the ceiling, aimed down and aside; its session states neither cone nor exact aim.
AreaTwin CeilingSpot(double inner_deg, double outer_deg) {
  AreaTwin twin;
  twin.light.name = "spot";
  twin.light.kind = LightKind::kSpot;
  twin.light.position_m = Vec3{0.3, -0.2, 2.4};
  const Vec3 aim{0.25, 0.1, -1.0};
  twin.light.aim = aim * (1.0 / Length(aim));
  twin.inner_rad = RadiansFromDegrees(inner_deg).value();
  twin.outer_rad = RadiansFromDegrees(outer_deg).value();
  return twin;
}

// Three rings of four about the beam's foot on the floor, facing up.
std::vector<Pose> FloorRings(const AreaTwin& twin) {
  const Vec3& lamp = *twin.light.position_m;
  const Vec3& aim = *twin.light.aim;
  const double down = lamp[2] / -aim[2];
  const Vec3 foot = lamp + aim * down;
  const double rim = lamp[2] * std::tan(twin.outer_rad);
  std::vector<Pose> poses;
  for (int i = 0; i < 12; ++i) {
    const double r = rim * std::array<double, 3>{0.3, 0.62, 0.85}[static_cast<std::size_t>(i / 4)];
    const double f = 0.5 * std::numbers::pi * i + 0.4 * (i / 4);
    poses.push_back({{foot[0] + r * std::cos(f), foot[1] + r * std::sin(f), 0.0}, {0.0, 0.0, 1.0}});
  }
  return poses;
}

struct Hits {
  int intensity = 0, inner = 0, outer = 0, aim = 0;
};

TEST(SpotBeam, TwelveFloorReadingsHoldTheTruthWithinTheirIntervals) {
  constexpr int kTwins = test::TrialsOf(200);
  std::mt19937_64 random(77);
  std::normal_distribution<double> normal;
  Hits hits;
  for (int i = 0; i < kTwins; ++i) {
    AreaTwin twin = CeilingSpot(14.0, 32.0);
    twin.intensity_cd = 900.0;
    const std::vector<Pose> poses = FloorRings(twin);
    Session session = ReadAt(twin, poses, 0.01, random);
    LightDescription& said = session.lights.front();
    const Vec3 off{0.03 * normal(random), 0.03 * normal(random), 0.0};
    const Vec3 stated = *said.aim + off;
    said.aim = stated * (1.0 / Length(stated));
    const auto fitted = FitSession(session, {});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    const FittedLight& light = fitted->lights.lights.front();
    hits.intensity += twin.intensity_cd >= *light.intensity_cd->low &&
                      twin.intensity_cd <= *light.intensity_cd->high;
    hits.inner += std::abs(*light.inner_deg - 14.0) <= *light.inner_u95_deg;
    hits.outer += std::abs(*light.outer_deg - 32.0) <= *light.outer_u95_deg;
    const double miss = DegreesFromRadians(AngleFromAim(*twin.light.aim, *light.aim));
    hits.aim += miss <= 1.25 * *light.aim_u95_deg;  // of two directions together: 2.45/1.96
    if (i == 0) {
      EXPECT_LT(*light.outer_u95_deg, 3.0);
      EXPECT_LT(*light.inner_u95_deg, 4.0);
      EXPECT_LT(*light.aim_u95_deg, 1.5);
    }
  }
  if (test::kUnderAddressSanitizer) return;
  EXPECT_GE(hits.intensity, 180);
  EXPECT_GE(hits.inner, 180);
  EXPECT_GE(hits.outer, 180);
  EXPECT_GE(hits.aim, 180);
}

// The light starts before or behind the stated place by as much as the prior allows: no reading is
// taken for a slip of units or for light that grows with distance, and the intervals hold.
TEST(SpotBeam, AnOffsetAsLargeAsItsPriorStaysWithinTheIntervals) {
  constexpr int kTwins = test::TrialsOf(150);
  std::mt19937_64 random(78);
  std::normal_distribution<double> normal;
  Hits hits;
  double inner_z = 0.0;
  double outer_z = 0.0;
  for (int i = 0; i < kTwins; ++i) {
    AreaTwin twin = CeilingSpot(14.0, 32.0);
    twin.intensity_cd = 900.0;
    const std::vector<Pose> poses = FloorRings(twin);
    const OffsetPart prior = MatchedOffset(OffsetParts(std::nullopt));
    twin.offset_m = prior.mean_m + prior.sd_m * normal(random);
    Session session = ReadAt(twin, poses, 0.01, random);
    LightDescription& said = session.lights.front();
    const Vec3 stated = *said.aim + Vec3{0.03 * normal(random), 0.03 * normal(random), 0.0};
    said.aim = stated * (1.0 / Length(stated));
    const auto fitted = FitSession(session, {});
    ASSERT_TRUE(fitted.has_value()) << i << " " << fitted.error().message;
    const FittedLight& light = fitted->lights.lights.front();
    hits.intensity += twin.intensity_cd >= *light.intensity_cd->low &&
                      twin.intensity_cd <= *light.intensity_cd->high;
    const double inner = (*light.inner_deg - 14.0) / *light.inner_u95_deg;
    const double outer = (*light.outer_deg - 32.0) / *light.outer_u95_deg;
    hits.inner += std::abs(inner) <= 1.0;
    hits.outer += std::abs(outer) <= 1.0;
    inner_z += std::pow(kZ95 * inner, 2) / kTwins;
    outer_z += std::pow(kZ95 * outer, 2) / kTwins;
  }
  if (test::kUnderAddressSanitizer) return;
  EXPECT_GE(hits.intensity, 137);  // of 95 %, less than two standard deviations
  EXPECT_GE(hits.inner, 137);
  EXPECT_GE(hits.outer, 137);
  EXPECT_LT(std::sqrt(inner_z), 1.1);
  EXPECT_LT(std::sqrt(outer_z), 1.1);
}

TEST(SpotBeam, WithoutAStatedAimItIsFoundToo) {
  AreaTwin twin = CeilingSpot(20.0, 35.0);
  twin.intensity_cd = 500.0;
  std::mt19937_64 random(3);
  Session session = ReadAt(twin, FloorRings(twin), 0.0, random);
  for (SessionReading& row : session.readings) row.reading.sigma_relative = 0.01;
  session.lights.front().aim.reset();
  const auto fitted = FitSession(session, {});
  ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
  const FittedLight& light = fitted->lights.lights.front();
  EXPECT_LT(DegreesFromRadians(AngleFromAim(*twin.light.aim, *light.aim)), 0.5);
  EXPECT_NEAR(*light.outer_deg, 35.0, 1.0);
  EXPECT_NEAR(*light.inner_deg, 20.0, 1.5);
  EXPECT_NEAR(light.intensity_cd->value, 500.0, 25.0);
}

TEST(SpotBeam, AStatedConeIsKept) {
  AreaTwin twin = CeilingSpot(20.0, 35.0);
  twin.intensity_cd = 500.0;
  std::mt19937_64 random(4);
  Session session = ReadAt(twin, FloorRings(twin), 0.01, random);
  session.lights.front().outer = RadiansFromDegrees(35.0);
  session.lights.front().inner = RadiansFromDegrees(20.0);
  const auto fitted = FitSession(session, {});
  ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
  const FittedLight& light = fitted->lights.lights.front();
  EXPECT_NEAR(*light.outer_deg, 35.0, 1e-9);
  EXPECT_FALSE(light.outer_u95_deg.has_value());
  EXPECT_NEAR(light.intensity_cd->value, 500.0, light.intensity_cd->u95);
}

}  // namespace
}  // namespace lightcal
