// SPDX-License-Identifier: Apache-2.0
// The seed's errors about lamps and what they cast (its section 5.2, 5.5 and 7.4); rows.txt lists
// them. Each test holds the seed's reading as `seed` and fails when lightcal returns it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "lightcal/photometry/cosine_law.h"
#include "lightcal/photometry/falloff_windows.h"
#include "lightcal/photometry/inverse_square.h"
#include "lightcal/photometry/lambert.h"
#include "lightcal/photometry/solid_angle.h"
#include "lightcal/photometry/spot_cone.h"
#include "quadrature.h"

namespace lightcal {
namespace {

using std::numbers::pi;

Radians Degrees(double degrees) { return RadiansFromDegrees(degrees); }

TEST(SeedErrors, IntensityIsIlluminanceTimesDistanceSquared) {
  const double seed = 192.0 / (0.5 * 0.5);
  const double ours = CandelaFromLux(Lux(192.0), Metres(0.5)).value();
  EXPECT_DOUBLE_EQ(ours, 48.0);
  EXPECT_GT(std::abs(ours - seed), 700.0);
}

TEST(SeedErrors, FluxOfAPointLampCarriesTheSineOfTheSphere) {
  const double seed = 100.0 * pi * 2.0 * pi;  // int int I dtheta dphi, as printed
  const double ours = 100.0 * SolidAngleOfCone(Radians(pi)).value();
  EXPECT_NEAR(ours, test::IntegrateOverSphere([](double) { return 100.0; }), 1e-5);
  EXPECT_DOUBLE_EQ(ours, 400.0 * pi);
  EXPECT_NEAR(seed / ours, pi / 2.0, 1e-12);
}

TEST(SeedErrors, SolidAngleOfAConeTakesTheCosineOfItsHalfAngle) {
  const double outer = 1.0;
  const double seed = 2.0 * pi * (1.0 - std::cos(outer / 2.0));
  const double ours = SolidAngleOfCone(Radians(outer)).value();
  EXPECT_NEAR(ours, 2.0 * pi * (1.0 - std::cos(outer)), 1e-14);
  EXPECT_NEAR(ours, 2.0 * pi * test::Integrate([](double t) { return std::sin(t); }, 0.0, outer),
              1e-8);
  EXPECT_GT(ours / seed, 3.7);
}

// The seed reads one angle as full in the flux and as half in the attenuation.
TEST(SeedErrors, OneConeAngleServesFluxAndAttenuationAlike) {
  const SpotCone cone{Radians(0.0), HalfAngleFromFull(Degrees(90.0))};
  EXPECT_NEAR(DegreesFromRadians(cone.outer), 45.0, 1e-12);
  EXPECT_GT(SpotAttenuation(Degrees(44.9), cone, SpotFalloff::kHard), 0.0);
  EXPECT_EQ(SpotAttenuation(Degrees(45.1), cone, SpotFalloff::kHard), 0.0);
  const double ours = FluxOfSpot(Candela(1.0), cone, SpotFalloff::kHard).value();
  EXPECT_NEAR(ours, test::IntegrateOverSphere([&cone](double theta) {
                return SpotAttenuation(Radians(theta), cone, SpotFalloff::kHard);
              }),
              1e-3);
  // An attenuation that reads 90 degrees as the half angle passes 3.4 times the flux that is
  // stated.
  const SpotCone seed{Radians(0.0), Degrees(90.0)};
  EXPECT_GT(FluxOfSpot(Candela(1.0), seed, SpotFalloff::kHard).value() / ours, 3.4);
  EXPECT_NEAR(DegreesFromRadians(FullAngleFromHalf(cone.outer)), 90.0, 1e-12);
}

TEST(SeedErrors, IntensityFromFluxHalvesTheAngleNotTheCosine) {
  struct Case {
    double apex_deg, seed_over_true;
  };
  for (const Case& c : {Case{10.0, 0.0075}, {60.0, 0.18}, {120.0, 0.40}, {180.0, 0.67}}) {
    const double apex = Degrees(c.apex_deg).value();
    const double seed = 1000.0 / (2.0 * pi * (1.0 - std::cos(apex) * 0.5));
    const SpotCone cone{Radians(0.0), HalfAngleFromFull(Radians(apex))};
    const double ours = AxialCandelaOfSpot(Lumens(1000.0), cone, SpotFalloff::kHard).value();
    EXPECT_NEAR(ours, 1000.0 / (2.0 * pi * (1.0 - std::cos(apex * 0.5))), 1e-9 * ours);
    EXPECT_NEAR(seed / ours, c.seed_over_true, 0.02 * c.seed_over_true);
  }
}

TEST(SeedErrors, FluxOfASpotIncludesItsPenumbra) {
  for (const auto& [inner, outer, excess] : {std::array{0.0, 35.0, 3.0}, {30.0, 45.0, 1.57}}) {
    const SpotCone cone{Degrees(inner), Degrees(outer)};
    const double seed = 2.0 * pi * (1.0 - std::cos(cone.outer.value()));
    const double ours = FluxOfSpot(Candela(1.0), cone, SpotFalloff::kSquaredLinear).value();
    EXPECT_NEAR(ours, test::IntegrateOverSphere([&cone](double theta) {
                  return SpotAttenuation(Radians(theta), cone, SpotFalloff::kSquaredLinear);
                }),
                1e-5);
    EXPECT_NEAR(seed / ours, excess, 0.005);
  }
}

TEST(SeedErrors, SpotAttenuationIsClampedAndSquared) {
  const SpotCone cone{Degrees(20.0), Degrees(40.0)};
  const auto seed = [](double degrees) {
    return (std::cos(Degrees(degrees).value()) - std::cos(Degrees(40.0).value())) /
           (std::cos(Degrees(20.0).value()) - std::cos(Degrees(40.0).value()));
  };
  const auto ours = [&cone](double degrees) {
    return SpotAttenuation(Degrees(degrees), cone, SpotFalloff::kSquaredLinear);
  };
  EXPECT_NEAR(ours(30.0), seed(30.0) * seed(30.0), 1e-13);
  EXPECT_GT(seed(30.0) - ours(30.0), 0.2);
  EXPECT_EQ(ours(0.0), 1.0);
  EXPECT_GT(seed(0.0), 1.3);
  EXPECT_EQ(ours(90.0), 0.0);
  EXPECT_LT(seed(90.0), -4.0);
}

TEST(SeedErrors, DirectionsPointTheWayTheirNamesSay) {
  const Vec3 aim{0.0, 0.0, -1.0};
  const Vec3 floor_normal{0.0, 0.0, 1.0};
  // Light that travels down lights a floor; the opposite reading of "lightDirection" leaves it
  // dark.
  EXPECT_EQ(CosIncidence(floor_normal, aim), 1.0);
  EXPECT_EQ(LuxOnTiltedPlane(Lux(100.0), CosIncidence(floor_normal, aim)).value(), 100.0);
  EXPECT_EQ(LuxOnTiltedPlane(Lux(100.0), CosIncidence(floor_normal, aim * -1.0)).value(), 0.0);
  const SpotCone cone{Degrees(10.0), Degrees(20.0)};
  const auto lit = [&](const Vec3& lamp_to_point) {
    return SpotAttenuation(AngleFromAim(aim, lamp_to_point), cone, SpotFalloff::kSquaredLinear);
  };
  EXPECT_EQ(lit({0.0, 0.0, -3.0}), 1.0);
  EXPECT_EQ(lit({0.0, 0.0, 3.0}), 0.0);
}

TEST(SeedErrors, ThePiConventionIsTrueOfOneConeOnly) {
  const double seed = FluxOfSpotByPiConvention(Candela(100.0)).value();
  EXPECT_DOUBLE_EQ(seed, 100.0 * pi);
  const auto ours = [](double half_deg) {
    return FluxOfSpot(Candela(100.0), {Radians(0.0), Degrees(half_deg)}, SpotFalloff::kHard)
        .value();
  };
  EXPECT_NEAR(ours(60.0), seed, 1e-9);
  EXPECT_LT(ours(20.0) / seed, 0.13);
  EXPECT_NEAR(ours(90.0) / seed, 2.0, 1e-12);
}

TEST(SeedErrors, UnrealsOneIsASquareCentimetre) {
  for (const auto& [distance, loss] : {std::array{0.5, 0.80}, {1.0, 0.50}, {5.0, 0.038}}) {
    const double seed = 1.0 / (distance * distance + 1.0);
    const double ours = UnrealFalloff(Metres(distance), kNoRange);
    EXPECT_NEAR(ours * distance * distance, 1.0, 4.1e-4);
    EXPECT_NEAR(1.0 - seed / ours, loss, 0.004);
  }
}

TEST(SeedErrors, TheInverseSquareConvergesToZeroWithoutReachingIt) {
  double before = LuxFromCandela(Candela(1.0), Metres(1.0)).value();
  for (double d = 10.0; d <= 1e12; d *= 10.0) {
    const double here = LuxFromCandela(Candela(1.0), Metres(d)).value();
    EXPECT_NEAR(here / before, 0.01, 1e-12);  // below every bound in the end
    EXPECT_GT(here, 0.0);
    before = here;
  }
  EXPECT_LT(before, 2e-24);
}

TEST(SeedErrors, IlluminanceDivergesAtShortDistanceWhileFluxStays) {
  const Candela lamp(10.0);
  EXPECT_GT(LuxFromCandela(lamp, Metres(1e-3)).value(), 9e6);
  for (const double d : {1e-6, 1e-3, 1.0, 1e3}) {
    const double sphere_area = 4.0 * pi * d * d;
    EXPECT_NEAR(LuxFromCandela(lamp, Metres(d)).value() * sphere_area, 40.0 * pi, 1e-9);
  }
}

TEST(SeedErrors, AbsentRangeIsNoRangeWhileATinyOneKillsTheLight) {
  EXPECT_EQ(FilamentFalloff(Metres(1.0), Metres(1e-6)), 0.0);  // the seed's advice
  EXPECT_EQ(FilamentFalloff(Metres(1.0), kNoRange), 1.0);
  for (const double r : {0.0, -1.0}) {  // the seed's code divides by it
    EXPECT_EQ(FilamentFalloff(Metres(1.0), Metres(r)), 1.0);
    EXPECT_EQ(UnityHdrpFalloff(Metres(1.0), Metres(r)), 1.0);
    EXPECT_EQ(GltfFalloff(Metres(1.0), Metres(r)), 1.0);
  }
}

TEST(SeedErrors, WhatFallsOnASurfaceIsIlluminanceNotLuminance) {
  static_assert(std::is_same_v<decltype(LuxOnTiltedPlane(Lux(1.0), 1.0)), Lux>);
  static_assert(!std::is_constructible_v<Lux, Nits>);
  static_assert(!std::is_invocable_v<decltype(LuxOnTiltedPlane), Nits, double>);
  // Two disks of one intensity: luminances 100 times apart, the same E_perp.
  const Candela small = AxialCandelaOfFlatSource(Nits(10000.0), SquareMetres(0.01));
  const Candela large = AxialCandelaOfFlatSource(Nits(100.0), SquareMetres(1.0));
  const ReceiverPose at{Metres(20.0), Metres(0.0), 0.5};
  EXPECT_DOUBLE_EQ(LuxFromCandela(small, at).value(), 0.125);
  EXPECT_DOUBLE_EQ(LuxFromCandela(large, at).value(), 0.125);
}

TEST(SeedErrors, ReflectionTakesTheCosineOfTheIncidentDirection) {
  constexpr double kReflectance = 0.5;
  constexpr double kIncident = 80.0;
  // A matt surface under a uniform dome shows reflectance x luminance from every side.
  double ours = 0.0;
  constexpr int kRings = 2000;
  for (int i = 0; i < kRings; ++i) {
    const double step = pi / 2.0 / kRings;
    const double theta = (i + 0.5) * step;
    const Steradians ring(2.0 * pi * std::sin(theta) * step);
    ours +=
        LuminanceReflectedFrom(kReflectance / pi, Nits(kIncident), std::cos(theta), ring).value();
  }
  EXPECT_NEAR(ours, kReflectance * kIncident, 1e-4);
  for (const double cos_out : {1.0, 0.8, 0.1}) {
    const double seed = kReflectance / pi * kIncident * cos_out * 2.0 * pi;
    EXPECT_GT(std::abs(seed - ours), 0.5 * ours);
  }
  EXPECT_EQ(LuminanceReflectedFrom(1.0, Nits(1.0), -0.5, Steradians(1.0)).value(), 0.0);
}

}  // namespace
}  // namespace lightcal
