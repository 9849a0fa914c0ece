// SPDX-License-Identifier: Apache-2.0
// Every kind of light: flux, intensity, luminance and illuminance against brute-force quadrature of
// its surface, written here from the definition dE = L cos cos dA/r^2.
#include "lightcal/photometry/source_photometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "lightcal/photometry/area_illuminance.h"
#include "quadrature.h"

namespace lightcal {
namespace {

using std::numbers::pi;

// dE from a surface element at p of unit normal m, to a receiver at z = d looking down the z axis.
double Element(const Vec3& p, const Vec3& m, double d) {
  const Vec3 to{-p[0], -p[1], d - p[2]};
  const double r2 = Dot(to, to);
  const double cos_source = Dot(m, to) / std::sqrt(r2);
  const double cos_receiver = to[2] / std::sqrt(r2);
  return cos_source > 0.0 && cos_receiver > 0.0 ? cos_source * cos_receiver / r2 : 0.0;
}

TEST(AreaIlluminance, ADiskAgreesWithTheQuadratureOfItsRings) {
  for (const double d : {0.01, 0.2, 1.0, 10.0}) {
    const double brute = test::Integrate(
        [d](double r) { return 2.0 * pi * r * Element({r, 0, 0}, {0, 0, 1}, d); }, 0.0, 0.3);
    EXPECT_NEAR(LuxPerNitOfDisk(Metres(0.3), Metres(d)) / brute, 1.0, 1e-4) << d;
  }
}

TEST(AreaIlluminance, ARectangleAgreesWithTheQuadratureOfItsElements) {
  for (const double d : {0.1, 1.0, 10.0}) {
    const double brute = test::Integrate(
        [d](double x) {
          return test::Integrate([x, d](double y) { return Element({x, y, 0}, {0, 0, 1}, d); },
                                 -0.3, 0.3, 600);
        },
        -0.6, 0.6, 1200);
    EXPECT_NEAR(LuxPerNitOfRect(Metres(1.2), Metres(0.6), Metres(d)) / brute, 1.0, 1e-5) << d;
  }
}

TEST(AreaIlluminance, ASphereAgreesWithTheQuadratureOfItsCap) {
  for (const double d : {0.35, 1.0, 10.0}) {
    const double brute = test::Integrate(
        [d](double t) {
          const Vec3 m{std::sin(t), 0, std::cos(t)};
          return 2.0 * pi * 0.3 * 0.3 * std::sin(t) * Element(m * 0.3, m, d);
        },
        0.0, pi, 40000);
    EXPECT_NEAR(LuxPerNitOfSphere(Metres(0.3), Metres(d)) / brute, 1.0, 1e-5) << d;
  }
}

TEST(AreaIlluminance, ATubeAgreesWithTheQuadratureOfItsMantle) {
  for (const double d : {0.06, 0.2, 1.0, 10.0}) {
    const double brute = test::Integrate(
        [d](double y) {
          return test::Integrate(
              [y, d](double phi) {
                const Vec3 m{std::sin(phi), 0, std::cos(phi)};
                return 0.05 * Element({0.05 * m[0], y, 0.05 * m[2]}, m, d);
              },
              -pi / 2.0, pi / 2.0, 2000);
        },
        -0.6, 0.6, 2000);
    EXPECT_NEAR(LuxPerNitOfTube(Metres(1.2), Metres(0.05), Metres(d)) / brute, 1.0, 2e-5) << d;
  }
}

TEST(AreaIlluminance, EveryShapeTouchedIsAWallOfLight) {
  EXPECT_NEAR(LuxPerNitOfDisk(Metres(1.0), Metres(1e-9)), pi, 1e-12);
  EXPECT_NEAR(LuxPerNitOfRect(Metres(1.0), Metres(2.0), Metres(1e-9)), pi, 1e-7);
  EXPECT_NEAR(LuxPerNitOfTube(Metres(1.0), Metres(0.1), Metres(0.1 * (1.0 + 1e-10))), pi, 1e-4);
  EXPECT_NEAR(LuxPerNitOfSphere(Metres(1.0), Metres(1.0 + 1e-12)), pi, 1e-11);
}

TEST(AreaIlluminance, EveryShapeFarAwayIsAPoint) {
  const double d = 1e5;
  EXPECT_NEAR(LuxPerNitOfDisk(Metres(0.3), Metres(d)) * d * d / (pi * 0.09), 1.0, 1e-10);
  EXPECT_NEAR(LuxPerNitOfRect(Metres(1.2), Metres(0.6), Metres(d)) * d * d / 0.72, 1.0, 1e-9);
  EXPECT_NEAR(LuxPerNitOfTube(Metres(1.2), Metres(0.05), Metres(d)) * d * d / 0.12, 1.0, 1e-6);
}

// An endless cylinder fills sin^-1(R/d) either side: E = pi L R/d, exactly.
TEST(AreaIlluminance, AnEndlessTubeFallsWithTheDistanceItself) {
  for (const double d : {0.11, 1.0, 50.0}) {
    EXPECT_NEAR(LuxPerNitOfTube(Metres(1e9), Metres(0.1), Metres(d)) / (pi * 0.1 / d), 1.0, 1e-6);
  }
}

// To first order in R/d a short tube is a point pi/8 of its radius nearer than its axis.
TEST(AreaIlluminance, AThinTubeKeepsItsDigitsAtAnyDistance) {
  for (const double d : {1e2, 1e4, 1e6, 1e8}) {
    const double relative = LuxPerNitOfTube(Metres(1e-3), Metres(1.0), Metres(d)) * d * d / 2e-3;
    EXPECT_NEAR((relative - 1.0) * d, pi / 4.0, std::max(3.0 / d, 1e-15 * d)) << d;
  }
}

SourceGeometry Geometry(LightKind kind) {
  SourceGeometry g;
  g.kind = kind;
  g.distance = Metres(2.0);
  g.radius = Metres(0.05);
  g.width = Metres(1.2);
  g.height = Metres(0.6);
  g.length = Metres(1.5);
  g.cone = SpotCone{RadiansFromDegrees(15.0), RadiansFromDegrees(25.0)};
  g.angular_radius = RadiansFromDegrees(0.265);
  return g;
}

class EveryKind : public testing::TestWithParam<LightKind> {};

TEST_P(EveryKind, ComesBackToItselfFromEachOfItsQuantities) {
  const SourceGeometry g = Geometry(GetParam());
  const auto first = ConvertSource(g, SourceQuantity::kIlluminance, 250.0);
  ASSERT_TRUE(first.has_value());
  const auto again = [&](SourceQuantity quantity, double value) {
    return ConvertSource(g, quantity, value)->illuminance->value();
  };
  if (first->flux) {
    EXPECT_NEAR(again(SourceQuantity::kFlux, first->flux->value()), 250.0, 1e-10);
  }
  if (first->intensity) {
    EXPECT_NEAR(again(SourceQuantity::kIntensity, first->intensity->value()), 250.0, 1e-10);
  }
  if (first->luminance) {
    EXPECT_NEAR(again(SourceQuantity::kLuminance, first->luminance->value()), 250.0, 1e-10);
    EXPECT_NEAR(again(SourceQuantity::kExitance, first->exitance->value()), 250.0, 1e-10);
    EXPECT_NEAR(first->exitance->value() / first->luminance->value(), pi, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind,
                         testing::Values(LightKind::kPoint, LightKind::kSpot, LightKind::kSphere,
                                         LightKind::kDisk, LightKind::kRect, LightKind::kTube,
                                         LightKind::kDirectional, LightKind::kDome),
                         [](const auto& test) { return std::string(LightKindName(test.param)); });

// Flux = exitance x emitting area, an independent way to the same number.
TEST(SourcePhotometry, FluxIsExitanceTimesEmittingArea) {
  struct Case {
    LightKind kind;
    double area;
  };
  for (const Case& c : {Case{LightKind::kSphere, 4.0 * pi * 0.05 * 0.05},
                        {LightKind::kDisk, pi * 0.05 * 0.05},
                        {LightKind::kRect, 1.2 * 0.6},
                        {LightKind::kTube, 2.0 * pi * 0.05 * 1.5}}) {
    const auto all = ConvertSource(Geometry(c.kind), SourceQuantity::kLuminance, 1500.0);
    EXPECT_NEAR(all->flux->value(), all->exitance->value() * c.area, 1e-9) << LightKindName(c.kind);
  }
}

// A tube's intensity falls with the sine of the angle to its axis; its integral is the flux.
TEST(SourcePhotometry, ATubesFluxIsTheIntegralOfItsSineLobe) {
  const auto all = ConvertSource(Geometry(LightKind::kTube), SourceQuantity::kIntensity, 100.0);
  EXPECT_NEAR(all->flux->value(),
              test::IntegrateOverSphere([](double theta) { return 100.0 * std::sin(theta); }),
              1e-3);
}

// The sun: 100 klx through a disk of 0.53 degrees has about 1.5e9 cd/m2.
TEST(SourcePhotometry, TheSunsLuminanceFollowsFromItsIlluminanceAndSize) {
  const auto sun =
      ConvertSource(Geometry(LightKind::kDirectional), SourceQuantity::kIlluminance, 1e5);
  EXPECT_NEAR(sun->luminance->value(), 1.488e9, 1e6);
  EXPECT_FALSE(sun->flux || sun->intensity);
}

TEST(SourcePhotometry, ThePiConventionLeavesIntensityAloneWhenTheConeTurns) {
  SourceGeometry g = Geometry(LightKind::kSpot);
  g.spot_flux = SpotFlux::kPiConvention;
  const double before = ConvertSource(g, SourceQuantity::kFlux, 806.0)->intensity->value();
  g.cone = SpotCone{Radians(0.0), RadiansFromDegrees(5.0)};
  EXPECT_EQ(ConvertSource(g, SourceQuantity::kFlux, 806.0)->intensity->value(), before);
  EXPECT_NEAR(before, 806.0 / pi, 1e-12);
}

void ExpectError(const SourceGeometry& g, SourceQuantity quantity, double value,
                 const std::string& code) {
  const auto all = ConvertSource(g, quantity, value);
  ASSERT_FALSE(all.has_value()) << code;
  EXPECT_EQ(all.error().code, code);
  EXPECT_FALSE(all.error().message.empty());
}

TEST(SourcePhotometry, WhatCannotBeIsRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  SourceGeometry g = Geometry(LightKind::kSphere);
  for (const double value : {0.0, -1.0, kNan, HUGE_VAL}) {
    ExpectError(g, SourceQuantity::kFlux, value, "not_positive");
  }
  ExpectError(g, SourceQuantity::kFlux, 1e308, "out_of_range");
  g.distance = Metres(0.05);
  ExpectError(g, SourceQuantity::kFlux, 1.0, "inside_source");
  g.distance = Metres(0.0);
  ExpectError(g, SourceQuantity::kFlux, 1.0, "not_positive");
  g = Geometry(LightKind::kSpot);
  g.cone->outer = Radians(0.0);
  ExpectError(g, SourceQuantity::kFlux, 1.0, "bad_cone");
  g.cone = SpotCone{Radians(-0.1), Radians(0.5)};
  ExpectError(g, SourceQuantity::kFlux, 1.0, "bad_cone");
  g = Geometry(LightKind::kDirectional);
  g.angular_radius = Radians(2.0);
  ExpectError(g, SourceQuantity::kIlluminance, 1.0, "bad_angle");
  g = Geometry(LightKind::kTube);
  g.distance = Metres(0.04);
  ExpectError(g, SourceQuantity::kFlux, 1.0, "inside_source");
}

TEST(SourcePhotometry, WhatIsMissingIsAQuestionOfUsage) {
  SourceGeometry bare;
  for (const LightKind kind : {LightKind::kSpot, LightKind::kSphere, LightKind::kDisk,
                               LightKind::kRect, LightKind::kTube, LightKind::kPhotometric}) {
    bare.kind = kind;
    ExpectError(bare, SourceQuantity::kIntensity, 1.0, "usage");
  }
  bare.kind = LightKind::kPoint;
  ExpectError(bare, SourceQuantity::kLuminance, 1.0, "usage");
  ExpectError(bare, SourceQuantity::kIlluminance, 1.0, "usage");
  bare.kind = LightKind::kDirectional;
  ExpectError(bare, SourceQuantity::kLuminance, 1.0, "usage");
  ExpectError(bare, SourceQuantity::kIntensity, 1.0, "usage");
  bare.kind = LightKind::kDome;
  ExpectError(bare, SourceQuantity::kFlux, 1.0, "usage");
}

}  // namespace
}  // namespace lightcal
