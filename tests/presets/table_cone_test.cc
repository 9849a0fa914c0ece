// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/table_cone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "lightcal/presets/filament_cone.h"

namespace lightcal::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

IntensityTable TableFrom(const std::function<double(double, double)>& candela) {
  IntensityGrid grid{GoniometerType::kC, {0.0, 90.0, 180.0, 270.0, 360.0}, {}, {}};
  for (int gamma = 0; gamma <= 180; ++gamma) grid.vertical_deg.push_back(gamma);
  for (const double c : grid.horizontal_deg) {
    for (const double gamma : grid.vertical_deg) {
      grid.candela.push_back(std::max(0.0, candela(c * kDegree, gamma * kDegree)));
    }
  }
  return *IntensityTable::Make(std::move(grid), "x");
}

double Spot(double gamma, double inner_deg, double outer_deg) {
  const double outer = std::cos(outer_deg * kDegree);
  const double t = (std::cos(gamma) - outer) / (std::cos(inner_deg * kDegree) - outer);
  return std::pow(std::clamp(t, 0.0, 1.0), 2);
}

TEST(TableCone, FindsTheConeOfATableThatIsASpot) {
  const auto found =
      SubstituteForTable(TableFrom([](double, double g) { return 700.0 * Spot(g, 12.0, 34.0); }));
  ASSERT_TRUE(found && found->cone);
  EXPECT_NEAR(DegreesFromRadians(found->cone->inner), 12.0, 1.5);
  EXPECT_NEAR(DegreesFromRadians(found->cone->outer), 34.0, 1.5);
  EXPECT_LT(found->worst, 0.03);
  EXPECT_NEAR(found->flux, 1.0, 0.01);
}

TEST(TableCone, ALampThatShinesAllRoundStaysAPoint) {
  const auto found =
      SubstituteForTable(TableFrom([](double, double g) { return 100.0 + 20.0 * std::cos(g); }));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->cone);
  EXPECT_NEAR(found->worst, 40.0 / 120.0, 0.01);
  EXPECT_NEAR(found->flux, 1.2, 1e-3);
}

// 10 cos^8 whose far side along C0 is half as bright: nothing of it is right off the axis but what
// the figures say.
TEST(TableCone, ItsErrorAndFluxAreThoseOfABruteForceSum) {
  const auto candela = [](double c, double g) {
    if (g > std::numbers::pi / 2.0) return 0.0;
    return 10.0 * std::pow(std::cos(g), 8) * (1.0 - 0.5 * std::sin(g) * std::cos(c));
  };
  const IntensityTable table = TableFrom(candela);
  const auto found = SubstituteForTable(table);
  ASSERT_TRUE(found && found->cone);
  const double inner = DegreesFromRadians(found->cone->inner);
  const double outer = DegreesFromRadians(found->cone->outer);
  double worst = 0.0, ours = 0.0, theirs = 0.0;
  for (double g = 0.25; g < 180.0; g += 0.5) {
    for (double c = 0.0; c < 360.0; c += 5.0) {
      const double got = Spot(g * kDegree, inner, outer);
      const double was = table.At(Radians(c * kDegree), Radians(g * kDegree)).value() / 10.0;
      worst = std::max(worst, std::abs(got - was));
      ours += got * std::sin(g * kDegree);
      theirs += was * std::sin(g * kDegree);
    }
  }
  EXPECT_NEAR(found->worst, worst, 0.01);
  EXPECT_NEAR(found->flux, ours / theirs, 0.005);
}

TEST(TableCone, ATableThatIsDarkAlongItsAimHasNone) {
  EXPECT_FALSE(SubstituteForTable(
      TableFrom([](double, double g) { return 50.0 * std::sin(g) * (g > .2); })));
}

// Worked out from libs/math/include/math/fast.h in 64 bit.
TEST(FilamentCone, ItsCosineIsTheParabolaOfItsSource) {
  EXPECT_NEAR(FilamentCosine(Radians(0.0)), 1.0, 1e-15);
  EXPECT_NEAR(FilamentCosine(Radians(20.0 * kDegree)), 0.9400548696844995, 1e-12);
  EXPECT_NEAR(FilamentCosine(Radians(25.0 * kDegree)), 0.9068179869684498, 1e-12);
  EXPECT_NEAR(FilamentCosine(Radians(60.0 * kDegree)), 0.5, 1e-12);
  EXPECT_NEAR(FilamentCosine(Radians(90.0 * kDegree)), 0.0, 1e-12);
}

TEST(FilamentCone, ItsAnglesAreWrittenSoThatTheConeIsTheTrueOne) {
  for (const double degrees : {0.0, 0.5, 5.0, 20.0, 22.0, 42.0, 60.0, 89.0, 90.0}) {
    const Radians written = AngleForFilament(Radians(degrees * kDegree));
    EXPECT_NEAR(FilamentCosine(written), std::cos(degrees * kDegree), 1e-12) << degrees;
  }
}

}  // namespace
}  // namespace lightcal::test
