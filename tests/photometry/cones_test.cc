// SPDX-License-Identifier: Apache-2.0
// Solid angles and spot cones against quadrature and closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightcal/photometry/solid_angle.h"
#include "lightcal/photometry/spot_cone.h"
#include "quadrature.h"

namespace lightcal {
namespace {

using std::numbers::pi;

Radians Degrees(double degrees) { return RadiansFromDegrees(degrees); }

TEST(SolidAngle, AWholeSphereHasFourPiAndAHemisphereTwo) {
  EXPECT_DOUBLE_EQ(SolidAngleOfCone(Radians(pi)).value(), 4.0 * pi);
  EXPECT_NEAR(SolidAngleOfCone(Radians(pi / 2.0)).value(), 2.0 * pi, 1e-15);
  EXPECT_EQ(SolidAngleOfCone(Radians(0.0)).value(), 0.0);
}

// 1 - cos gives 0 here in double precision; a narrow cone is a flat disk of pi t^2.
TEST(SolidAngle, ANarrowConeKeepsItsDigits) {
  for (const double t : {1e-4, 1e-8, 1e-12}) {
    EXPECT_NEAR(SolidAngleOfCone(Radians(t)).value() / (pi * t * t), 1.0, 1e-9);
  }
  EXPECT_EQ(1.0 - std::cos(1e-9), 0.0);
}

TEST(SolidAngle, HalfAngleAndSolidAngleAreInverse) {
  for (const double degrees : {1e-6, 1.0, 45.0, 90.0, 179.0}) {
    const Radians back = ConeHalfAngleFromSolidAngle(SolidAngleOfCone(Degrees(degrees)));
    EXPECT_NEAR(DegreesFromRadians(back) / degrees, 1.0, 1e-12);
  }
}

TEST(SolidAngle, AZoneIsTheDifferenceOfItsCones) {
  EXPECT_NEAR(SolidAngleOfZone(Degrees(20.0), Degrees(35.0)).value(),
              (SolidAngleOfCone(Degrees(35.0)) - SolidAngleOfCone(Degrees(20.0))).value(), 1e-15);
}

class ConeFlux : public testing::TestWithParam<SpotFalloff> {};

TEST_P(ConeFlux, EqualsTheIntegralOfTheAttenuation) {
  for (const auto& [inner, outer] :
       {std::pair{0.0, 10.0}, {15.0, 25.0}, {30.0, 90.0}, {60.0, 180.0}}) {
    const SpotCone cone{Degrees(inner), Degrees(outer)};
    const double brute = test::IntegrateOverSphere(
        [&](double theta) { return SpotAttenuation(Radians(theta), cone, GetParam()); }, 180000);
    EXPECT_NEAR(SolidAngleOfSpot(cone, GetParam()).value(), brute, 2e-5) << inner << " " << outer;
    const Candela axial = AxialCandelaOfSpot(Lumens(806.0), cone, GetParam());
    EXPECT_NEAR(FluxOfSpot(axial, cone, GetParam()).value(), 806.0, 1e-10);
  }
}

TEST_P(ConeFlux, EqualAnglesMakeAHardEdgeWithoutDividingByZero) {
  const SpotCone cone{Degrees(30.0), Degrees(30.0)};
  EXPECT_EQ(SpotAttenuation(Degrees(29.999), cone, GetParam()), 1.0);
  EXPECT_EQ(SpotAttenuation(Degrees(30.001), cone, GetParam()), 0.0);
  EXPECT_NEAR(SolidAngleOfSpot(cone, GetParam()).value(), SolidAngleOfCone(Degrees(30.0)).value(),
              1e-14);
  // An inner angle beyond the outer one counts as the outer one.
  const SpotCone swapped{Degrees(50.0), Degrees(30.0)};
  EXPECT_EQ(SpotAttenuation(Degrees(40.0), swapped, GetParam()), 0.0);
  EXPECT_EQ(SolidAngleOfSpot(swapped, GetParam()).value(),
            SolidAngleOfSpot(cone, GetParam()).value());
}

TEST_P(ConeFlux, AttenuationNeverRisesAndStaysWithinZeroAndOne) {
  const SpotCone cone{Degrees(10.0), Degrees(40.0)};
  double before = 1.0;
  for (double degrees = 0.0; degrees <= 180.0; degrees += 0.25) {
    const double here = SpotAttenuation(Degrees(degrees), cone, GetParam());
    EXPECT_LE(here, before);
    EXPECT_GE(here, 0.0);
    before = here;
  }
  EXPECT_EQ(before, 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, ConeFlux,
                         testing::Values(SpotFalloff::kHard, SpotFalloff::kLinear,
                                         SpotFalloff::kSquaredLinear, SpotFalloff::kSmoothstep));

// Published with the formulas in the reference notes on engines: 15/25 degrees.
TEST(SpotCone, OneCandelaHasThreeFluxesUnderThreeFalloffs) {
  const SpotCone cone{Degrees(15.0), Degrees(25.0)};
  EXPECT_NEAR(SolidAngleOfSpot(cone, SpotFalloff::kHard).value(), 0.589, 5e-4);
  EXPECT_NEAR(SolidAngleOfSpot(cone, SpotFalloff::kSquaredLinear).value(), 0.339, 5e-4);
  EXPECT_NEAR(SolidAngleOfSpot(cone, SpotFalloff::kSmoothstep).value(), 0.401, 5e-4);
}

TEST(SpotCone, AngleFromAimIsExactNearTheAxisAndBehind) {
  EXPECT_NEAR(AngleFromAim({0, 0, -1}, {1e-9, 0, -1}).value(), 1e-9, 1e-24);
  EXPECT_NEAR(AngleFromAim({0, 0, -2}, {0, 0, 5}).value(), pi, 1e-15);
  EXPECT_NEAR(AngleFromAim({1, 0, 0}, {0, 3, 0}).value(), pi / 2.0, 1e-15);
}

}  // namespace
}  // namespace lightcal
