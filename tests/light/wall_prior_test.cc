// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/wall_prior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/light/fixture.h"

namespace lightcal {
namespace {

double WholeWeight(const std::vector<WallHypothesis>& all) {
  double whole = 0.0;
  for (const WallHypothesis& one : all) whole += one.weight;
  return whole;
}

TEST(WallPrior, WeightsOfEveryLampMakeOne) {
  for (const LightKind kind :
       {LightKind::kPoint, LightKind::kSphere, LightKind::kRect, LightKind::kSpot}) {
    LampSpread lamp;
    lamp.kind = kind;
    EXPECT_NEAR(WholeWeight(WallPriors(lamp, {})), 1.0, 1e-12);
    EXPECT_NEAR(WholeWeight(WallPriors(lamp, StatedRoom{{5.0, 4.0, 2.6}})), 1.0, 1e-12);
  }
}

// The 205 tables say where any lamp's light starts; what is known of a make says where that one's
// does. Nobody may learn from a room what a dark room denies.
TEST(WallPrior, OffsetsOfUnknownMakesLieWhereThoseOfTheTablesDo) {
  std::vector<OffsetPart> parts;
  for (const WallHypothesis& one : WallPriors({}, {})) {
    ASSERT_TRUE(one.offset.has_value());
    parts.push_back({one.weight, one.offset->mean_m, one.offset->sd_m});
  }
  const OffsetPart makes = MatchedOffset(parts);
  const OffsetPart tables = MatchedOffset(OffsetParts(std::nullopt));
  EXPECT_NEAR(makes.mean_m, tables.mean_m, 0.01);
  EXPECT_NEAR(makes.sd_m, tables.sd_m, 0.03);
}

// A make that was stated has one offset, which no hypothesis of the walls changes.
TEST(WallPrior, AStatedFixtureKeepsItsOwnOffset) {
  LampSpread lamp;
  lamp.fixture = Fixture::kBulb;
  EXPECT_TRUE(std::ranges::none_of(WallPriors(lamp, {}),
                                   [](const auto& one) { return one.offset.has_value(); }));
}

// Answers list what a lamp may be by weight: two alike would be listed in either order.
TEST(WallPrior, NoTwoMakesWeighAlike) {
  std::vector<double> weights;
  for (const WallHypothesis& one : WallPriors({}, {})) weights.push_back(one.weight);
  std::ranges::sort(weights);
  for (std::size_t i = 1; i < weights.size(); ++i) {
    EXPECT_GT(weights[i], weights[i - 1] + 1e-6);
  }
}

// A Lambertian wall .3 m behind a bulb, by its integral: what it adds at .5 m over what it adds at
// 3 m lies within the corner's and the near wall's prior, and beyond an ordinary place's.
TEST(WallPrior, AWallBehindABulbIsBetweenAnOrdinaryPlaceAndACorner) {
  LampSpread lamp;
  lamp.fixture = Fixture::kBulb;
  const std::vector<WallHypothesis> places = WallPriors(lamp, {});
  const auto steepest =
      std::ranges::min(places, {}, [](const auto& one) { return one.prior.slope; });
  const WallPrior& ordinary = places.front().prior;
  constexpr double kFromWall = 0.3;
  constexpr double kReflectance = 0.6;
  using std::numbers::pi;
  // E(d) = rho/pi int (h/s^3) cos_wall cos_meter / r^2 dA over rings about the axis.
  const auto wall_lux = [&](double d) {
    double sum = 0.0;
    constexpr int kRings = 4000;
    for (int i = 0; i < kRings; ++i) {
      const double ring = 4.0 * (i + 0.5) / kRings;
      const double s2 = ring * ring + kFromWall * kFromWall;
      const double z = d + kFromWall;
      const double r2 = ring * ring + z * z;
      sum += kFromWall / (s2 * std::sqrt(s2)) * (z * z / r2) / r2 * 2.0 * pi * ring * 4.0 / kRings;
    }
    return kReflectance / pi * sum;
  };
  const auto slope_with_wall = [&] {
    const auto ln_b = [&](double d) {
      return std::log(WallsPerCandela(ordinary, d) + wall_lux(d));
    };
    const double x = std::log(0.5 / kWallReference_m);
    return (ln_b(0.5) - ln_b(3.0) - ordinary.bend * x * x) / x;
  }();
  EXPECT_LT(slope_with_wall, ordinary.slope - 0.3);
  EXPECT_GT(slope_with_wall, steepest.prior.slope - steepest.prior.sd_slope);
}

// A room s times as large gives a meter s times as far 1/s^2 of the light: all solid angles are the
// same.
TEST(WallPrior, OfALargerRoomIsTheOrdinaryOnesScaled) {
  const Vec3 largest{8.0, 7.0, 3.0};  // 202 m^2: no traced room is larger
  for (const LightKind kind : {LightKind::kSphere, LightKind::kDisk, LightKind::kSpot}) {
    LampSpread lamp;
    lamp.kind = kind;
    const auto ordinary = WallPriors(lamp, StatedRoom{largest, 0.4, 0.04});
    for (const double s : {1.5, 4.0, 20.0}) {
      const auto larger = WallPriors(lamp, StatedRoom{largest * s, 0.4, 0.04});
      ASSERT_EQ(larger.size(), ordinary.size());
      for (std::size_t i = 0; i < larger.size(); ++i) {
        for (const double d : {0.5, 3.0, 6.0}) {
          EXPECT_NEAR(WallsPerCandela(larger[i].prior, s * d) * s * s /
                          WallsPerCandela(ordinary[i].prior, d),
                      1.0, 1e-9);
        }
      }
    }
  }
}

// Nobody says how large a room is in which a lamp is read 60 m away; it is no ordinary one.
TEST(WallPrior, WallsAddNoMoreToALongerThrow) {
  for (const LightKind kind : {LightKind::kPoint, LightKind::kSphere, LightKind::kSpot}) {
    LampSpread lamp;
    lamp.kind = kind;
    const auto share = [&](double d) {
      return d * d * WallsPerCandela(WallPriors(lamp, {}, Metres(d)).back().prior, d);
    };
    for (const double d : {7.0, 20.0, 60.0, 300.0}) EXPECT_NEAR(share(d) / share(6.0), 1.0, 1e-9);
    EXPECT_LT(share(3.0), share(6.0));
  }
}

}  // namespace
}  // namespace lightcal
