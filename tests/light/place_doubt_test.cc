// SPDX-License-Identifier: Apache-2.0
// What a lamp's place and strength, known together, leave open of its illuminance, against draws of
// both put through E = I exp(g.(u - middle)) cos/r^2 by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "lightcal/light/placed_lamp.h"

namespace lightcal {
namespace {

using Vector7 = std::array<double, 7>;  // ln I, x, y, z in m, g
using Matrix7 = std::array<Vector7, 7>;

// Rows of what standard normals are mixed by: some percent and 2 cm, leaning on each other.
Matrix7 SomeMixing(std::mt19937_64& random) {
  constexpr Vector7 kSd = {0.03, 0.02, 0.02, 0.02, 0.03, 0.03, 0.03};
  std::normal_distribution<double> normal;
  Matrix7 mixing{};
  for (int i = 0; i < 7; ++i) {
    for (double& element : mixing[i]) element = kSd[i] * normal(random) / std::sqrt(7.0);
  }
  return mixing;
}

double Along(const Vector7& a, const Vector7& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double ByHand(const Vector7& of, const SurfacePoint& at, const PlaceDoubt& doubt) {
  const Vec3 way = at.position_m - Vec3{of[1], of[2], of[3]};
  const double r = Length(way);
  const Vec3 u = way * (1.0 / r) - doubt.middle;
  const double uneven = of[4] * u[0] + of[5] * u[1] + of[6] * u[2];
  return std::exp(of[0] + uneven) * -Dot(way, at.normal) / (r * r * r);
}

TEST(PlaceDoubt, IsWhatDrawsOfStrengthPlaceAndPatternScatter) {
  std::mt19937_64 random(20261127);
  std::uniform_real_distribution<double> between(-1.0, 1.0);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 12; ++n) {
    PlacedLamp lamp;
    lamp.source = PointSource{};
    lamp.strength = 500.0;
    lamp.pose.position_m = {between(random), between(random), 2.0};
    PlaceDoubt doubt;
    doubt.middle = {0.1, -0.2, -0.6};
    const Matrix7 mixing = SomeMixing(random);
    for (int i = 0; i < 7; ++i) {
      for (int j = 0; j < 7; ++j) doubt.covariance[i * 7 + j] = Along(mixing[i], mixing[j]);
    }
    lamp.doubt.place = doubt;
    lamp.doubt.variance_ln = 1.0;  // not used: the place's holds it
    const SurfacePoint at{{between(random), between(random), 0.5 * between(random)}};

    const Vec3& place = lamp.pose.position_m;
    const Vector7 mean = {std::log(lamp.strength), place[0], place[1], place[2], 0.0, 0.0, 0.0};
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kDraws = 40000;
    for (int k = 0; k < kDraws; ++k) {
      Vector7 standard{};
      for (double& one : standard) one = normal(random);
      Vector7 draw = mean;
      for (int i = 0; i < 7; ++i) draw[i] += Along(mixing[i], standard);
      const double lux = ByHand(draw, at, doubt);
      sum += lux / kDraws;
      squares += lux * lux / kDraws;
    }
    const double sd = std::sqrt(squares - sum * sum);
    EXPECT_NEAR(DoubtOfLux(lamp, at, {}), sd, 0.03 * sd) << n;
  }
}

TEST(PlaceDoubt, APatternThatIsFoundWidensWhereItWouldShineOtherwise) {
  PlacedLamp lamp;
  lamp.source = PointSource{};
  lamp.strength = 500.0;
  lamp.pose.position_m = {0.0, 0.0, 2.0};
  lamp.doubt.place = PlaceDoubt{{0.0, 0.0, 0.1}, {0.0, 0.0, -1.0}, {}};
  // Below, where it was read, its strength is exact; at the side e^(.1 cos) of it is not shown.
  EXPECT_EQ(DoubtOfLux(lamp, {{0.0, 0.0, 0.0}}, {}), 0.0);
  const SurfacePoint side{{2.0, 0.0, 2.0}, {-1.0, 0.0, 0.0}};
  EXPECT_NEAR(DoubtOfLux(lamp, side, {}), 0.1 * 125.0, 1e-9);
}

}  // namespace
}  // namespace lightcal
