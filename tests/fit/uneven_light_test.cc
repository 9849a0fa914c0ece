// SPDX-License-Identifier: Apache-2.0
// What a point may shine more to one side than to another, and light that grows with distance only
// because meters were turned or cards took the walls out of some readings.
#include "lightcal/fit/model/uneven_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightcal/fit/model/input_checks.h"

namespace lightcal::fit {
namespace {

Observation At(const Vec3& position) {
  Observation o;
  o.lit = true;
  o.position_m = position;
  o.distance_m = Length(position);
  o.measured_lx = 100.0;
  o.sigma_lx = 1.0;
  return o;
}

LightDescription BulbAtTheOrigin() {
  LightDescription light;
  light.name = "bulb";
  light.kind = LightKind::kPoint;
  light.fixture = Fixture::kBulb;
  light.position_m = Vec3{};
  return light;
}

TEST(UnevenLight, OneDirectionTellsWhatItAsksFor) {
  Observations seen;
  seen.rows = {At({0.5, 0.0, 0.0}), At({1.0, 0.0, 0.0}), At({2.0, 0.05, 0.0})};
  EXPECT_TRUE(UnevenTowards(seen, BulbAtTheOrigin()).empty());
  // Another direction is told less: along the base's axis by .22.
  const UnevenLight uneven = UnevenOf(seen, BulbAtTheOrigin()).value();
  EXPECT_NEAR(SdTowards(uneven, {1.0, 0.0, 0.0}), 0.0, 2e-3);
  EXPECT_NEAR(SdTowards(uneven, {0.0, 0.0, 1.0}), std::hypot(0.09, 0.22), 2e-3);
}

TEST(UnevenLight, ReadingsOfOneDirectionShareWhatItShines) {
  Observations seen;
  seen.rows = {At({0.0, 0.0, 1.0}), At({0.0, 0.0, 2.0}), At({0.0, 0.0, -1.0}),
               At({0.0, 0.0, -2.0})};
  for (const double sd : UnevenTowards(seen, BulbAtTheOrigin())) {
    EXPECT_NEAR(sd, 0.22 * std::sqrt(2.0), 1e-12);
  }
  LightDescription other = BulbAtTheOrigin();
  other.kind = LightKind::kSphere;
  EXPECT_TRUE(UnevenTowards(seen, other).empty()) << "a ball shines alike";
}

TEST(UnevenLight, APointOfNoFixtureIsOneAndThatIsSaid) {
  Observations seen;
  seen.rows = {At({0.0, 0.0, 1.0}), At({0.0, 0.0, -1.0})};
  LightDescription light = BulbAtTheOrigin();
  EXPECT_FALSE(TakenToShineEvenly(seen, light));
  light.fixture.reset();
  EXPECT_TRUE(UnevenTowards(seen, light).empty());
  EXPECT_TRUE(TakenToShineEvenly(seen, light));
  seen.rows.pop_back();
  EXPECT_FALSE(TakenToShineEvenly(seen, light)) << "one direction tells what it asks for";
}

// A reading whose direction nobody knows may lie in any.
TEST(UnevenLight, WithoutAPlaceAnyDirectionIsPossible) {
  Observations seen;
  seen.rows = {At({0.0, 0.0, 1.0}), At({0.0, 0.0, -1.0}), At({1.0, 0.0, 0.0})};
  seen.rows[2].position_m.reset();
  EXPECT_NEAR(UnevenTowards(seen, BulbAtTheOrigin()).at(2),
              std::sqrt((2 * 0.09 * 0.09 + 0.22 * 0.22) / 3.0), 1e-12);
}

Observation Aside(double degrees) {
  Observation o = At({0.0, 0.0, 1.0});
  o.position_m.reset();
  o.off_axis_rad = degrees * 3.14159265358979 / 180.0;
  return o;
}

// Any number of readings aside, of either side, tells the axis what one of them does; the axis
// itself is what is sought, and every other one goes by the gradient of 2 sin(angle/2).
TEST(UnevenLight, ReadingsAsideShareWhatItShinesThere) {
  LightDescription light = BulbAtTheOrigin();
  light.position_m.reset();
  Observations seen;
  seen.rows = {Aside(0.0), Aside(0.0)};
  EXPECT_TRUE(UnevenTowards(seen, light).empty()) << "on the axis alone nothing changes";
  seen.rows = {Aside(0.0), Aside(60.0), Aside(-60.0), Aside(90.0)};
  const double rms = std::sqrt((2 * 0.09 * 0.09 + 0.22 * 0.22) / 3.0);
  const std::vector<double> sd = UnevenTowards(seen, light);
  ASSERT_EQ(sd.size(), 4U);
  EXPECT_EQ(sd[0], 0.0);
  EXPECT_NEAR(sd[1], rms * std::sqrt(3.0), 1e-12);
  EXPECT_EQ(sd[1], sd[2]);
  EXPECT_NEAR(sd[3], rms * std::sqrt(2.0) * std::sqrt(1.0 + std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(UnevenAside(light, RadiansFromDegrees(180.0)), 2.0 * rms, 1e-12);
  light.fixture.reset();
  EXPECT_EQ(UnevenTowards(seen, light), sd) << "whose fixture nobody states, as a bulb";
  light.kind = LightKind::kSphere;
  EXPECT_TRUE(UnevenTowards(seen, light).empty()) << "a ball shines alike";
}

Observation Turned(double distance_m, double cosine, double lamp_lx, double walls_lx) {
  Observation o;
  o.lit = true;
  o.distance_m = distance_m;
  o.tilt_rad = std::acos(cosine);
  o.measured_lx = lamp_lx * cosine / (distance_m * distance_m) + walls_lx;
  o.sigma_lx = 0.01 * o.measured_lx;
  return o;
}

TEST(CheckFalloff, WallsOnTurnedMetersAndCardsAtSomeAreNoGrowth) {
  LightDescription light;
  light.name = "lamp";
  Warnings warnings;
  Observations flat;  // a lamp .8 m above a table in a white room
  for (const double d : {0.85, 1.1, 1.6, 2.2}) flat.rows.push_back(Turned(d, 0.8 / d, 100.0, 60.0));
  EXPECT_TRUE(CheckFalloff(flat, light, warnings));

  Observations shaded;  // the nearer two less what a card left
  for (const double d : {2.0, 2.1, 2.3, 2.4}) shaded.rows.push_back(Turned(d, 0.9, 100.0, 60.0));
  for (int k : {0, 1}) {
    shaded.rows[k].measured_lx -= shaded.rows[k].card_lx = 60.0;
    shaded.rows[k].differenced = true;
  }
  EXPECT_TRUE(CheckFalloff(shaded, light, warnings));

  Observations swapped = flat;  // distances of the nearest and the farthest
  for (Observation& o : swapped.rows) o.tilt_rad = 0.0;
  std::swap(swapped.rows[0].distance_m, swapped.rows[3].distance_m);
  std::swap(swapped.rows[1].distance_m, swapped.rows[2].distance_m);
  EXPECT_EQ(CheckFalloff(swapped, light, warnings).error().code, "increasing_with_distance");
}

}  // namespace
}  // namespace lightcal::fit
