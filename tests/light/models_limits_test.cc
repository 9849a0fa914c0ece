// SPDX-License-Identifier: Apache-2.0
// Where the models' forms meet, end, or must equal a simpler law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/light/axial_shape.h"
#include "lightcal/light/models/source_model.h"

namespace lightcal {
namespace {

using std::numbers::pi;

// On the axis of any flat source (tube: broadside) at z = d, tilted by `tilt` toward x.
Receiver<double> OnAxis(double d, double tilt) {
  return {{0.0, 0.0, d}, {std::sin(tilt), 0.0, -std::cos(tilt)}};
}

TEST(Models, G06AreContinuousWhereTheHorizonFirstTouchesAndLastLeaves) {
  const std::vector<SourceModel> sources = {SphereSource{0.5}, DiskSource{0.5},
                                            RectSource{0.5, 0.3}, TubeSource{0.8, 0.5}};
  for (const SourceModel& source : sources) {
    for (const double d : {0.6, 2.0, 30.0, 1e4}) {
      const double whole = LuxPerCandela(source, OnAxis(d, 0.0));
      double before = whole;
      // Every tilt from facing to turned away: no step, and never below zero.
      for (int i = 1; i <= 4000; ++i) {
        const double e = LuxPerCandela(source, OnAxis(d, pi * i / 4000.0));
        ASSERT_GE(e, 0.0);
        ASSERT_LE(e, before + 1e-12 * whole);
        ASSERT_LE(before - e, 2.0 * whole * pi / 4000.0);
        before = e;
      }
      EXPECT_EQ(before, 0.0);
      const bool sphere = std::holds_alternative<SphereSource>(source);
      const bool tube = std::holds_alternative<TubeSource>(source);
      const double reach = tube ? std::atan2(0.8, d) : std::atan2(0.5, d);
      const double touch = sphere ? std::acos(0.5 / d) : 0.5 * pi - reach;
      for (const double tilt : {touch, pi - touch}) {
        const double step = std::abs(LuxPerCandela(source, OnAxis(d, tilt + 1e-14)) -
                                     LuxPerCandela(source, OnAxis(d, tilt - 1e-14)));
        EXPECT_LE(step, 1e-12 * whole) << "d " << d << " tilt " << tilt;
      }
    }
  }
}

TEST(Models, OnTheAxisTheyAreTheAxialShapes) {
  for (const double d : {0.05, 0.4, 3.0, 200.0}) {
    const Receiver<double> at = OnAxis(d, 0.0);
    const double d2 = d * d;
    const auto factor = [&](AxialShape::Outline outline, double a, double b) {
      return AxialShapeFactor({outline, a, b}, d) / d2;
    };
    EXPECT_NEAR(LuxPerCandela(DiskSource{0.3}, at) / factor(AxialShape::Outline::kDisk, 0.3, 0), 1,
                1e-13);
    EXPECT_NEAR(
        LuxPerCandela(RectSource{0.3, 0.1}, at) / factor(AxialShape::Outline::kRect, 0.3, 0.1), 1,
        1e-13);
    EXPECT_NEAR(
        LuxPerCandela(TubeSource{0.3, 0.0}, at) / factor(AxialShape::Outline::kTube, 0.3, 0), 1,
        1e-13);
  }
}

TEST(Models, G07AReceiverInAGlobeSeesItsLuminanceAllOver) {
  const double lux_per_candela = LuxPerCandela(SphereSource{0.2}, OnAxis(0.2, 0.3));
  EXPECT_NEAR(lux_per_candela * pi * 0.04, pi, 1e-12);  // E = pi L
  EXPECT_EQ(LuxPerCandela(SphereSource{0.2}, OnAxis(0.1, 0.3)), lux_per_candela);
}

TEST(Models, G09TouchingAFlatSourceIsUnderAWholeDome) {
  EXPECT_NEAR(LuxPerCandela(RectSource{1.0, 1.0}, OnAxis(1e-6, 0.0)) * 4.0, pi, 1e-5);
  EXPECT_NEAR(LuxPerCandela(DiskSource{1.0}, OnAxis(1e-6, 0.0)) * pi, pi, 1e-10);
}

TEST(Models, G10FarAwayEverySourceIsAPoint) {
  const double d = 1e6;
  const Receiver<double> at = OnAxis(d, 0.4);
  const double point = PointLuxPerCandela(at);
  for (const SourceModel& source :
       {SourceModel(SphereSource{1.0}), SourceModel(DiskSource{1.0}),
        SourceModel(RectSource{0.7, 0.7}), SourceModel(TubeSource{1.0, 1e-6})}) {
    EXPECT_NEAR(LuxPerCandela(source, at) / point, 1.0, 3e-12);
  }
}

TEST(Models, G05AndG12TheBackIsDarkAndTheWindingDoesNotMatter) {
  EXPECT_EQ(LuxPerCandela(DiskSource{1.0}, OnAxis(-0.1, 0.0)), 0.0);
  EXPECT_EQ(LuxPerCandela(RectSource{1.0, 1.0}, OnAxis(0.0, 0.0)), 0.0);
  const std::vector<std::array<double, 2>> one = {{0, 0}, {1, 0}, {1, 2}, {-1, 1}};
  const std::vector<std::array<double, 2>> other(one.rbegin(), one.rend());
  const Receiver<double> at{{0.3, -0.2, 0.7}, {0.6, 0.0, -0.8}};
  EXPECT_NEAR(PolygonLuxPerCandela<double>(one, at) / PolygonLuxPerCandela<double>(other, at), 1.0,
              1e-14);
}

TEST(Models, G13ADiskSeenFromItsAxisAndFromBesideItAgree) {
  Receiver<double> at = OnAxis(0.3, 0.2);
  const double on = LuxPerCandela(DiskSource{1.0}, at);
  at.position[0] = 1e-12;
  EXPECT_NEAR(LuxPerCandela(DiskSource{1.0}, at) / on, 1.0, 1e-12);
}

TEST(Models, G15ATubeSeenEndOnIsDark) {
  const Receiver<double> end_on{{3.0, 0.01, 0.0}, {-1.0, 0.0, 0.0}};
  EXPECT_EQ(LuxPerCandela(TubeSource{1.0, 0.02}, end_on), 0.0);
}

TEST(Models, InSinglePrecisionTheyKeepFiveDigits) {
  const std::vector<SourceModel> sources = {SphereSource{0.5}, DiskSource{0.5},
                                            RectSource{0.5, 0.3}, TubeSource{0.8, 0.1}};
  for (const SourceModel& source : sources) {
    for (const double d : {0.7, 3.0, 50.0, 2000.0}) {
      const Receiver<double> at{{0.2 * d, -0.1 * d, d}, {0.28, 0.0, -0.96}};
      const Receiver<float> narrow{
          {0.2F * static_cast<float>(d), -0.1F * static_cast<float>(d), static_cast<float>(d)},
          {0.28F, 0.0F, -0.96F}};
      EXPECT_NEAR(LuxPerCandela(source, narrow) / LuxPerCandela(source, at), 1.0, 2e-5) << d;
    }
  }
}

TEST(Models, ASpotIsAPointTimesItsProfile) {
  const SpotCone cone{RadiansFromDegrees(10.0), RadiansFromDegrees(30.0)};
  for (const double angle : {0.0, 0.15, 0.3, 0.5, 0.53, 1.0, 3.0}) {
    const Receiver<double> at{{2.0 * std::sin(angle), 0.0, 2.0 * std::cos(angle)},
                              {-std::sin(angle), 0.0, -std::cos(angle)}};
    for (const SpotFalloff falloff : {SpotFalloff::kHard, SpotFalloff::kLinear,
                                      SpotFalloff::kSquaredLinear, SpotFalloff::kSmoothstep}) {
      EXPECT_NEAR(LuxPerCandela(SpotSource{cone, falloff}, at),
                  0.25 * SpotAttenuation(Radians(angle), cone, falloff), 1e-13);
    }
  }
}

TEST(Models, ASunsDiskMattersOnlyAtTheHorizon) {
  const double radius = 0.00465;
  for (const double elevation : {0.0047, 0.3, 1.5}) {
    const Vec3 toward{std::cos(elevation), 0.0, std::sin(elevation)};
    const Vec3 up{0.0, 0.0, 1.0};
    EXPECT_NEAR(SunFactor(up, toward, radius), DirectionalFactor(up, toward), 1e-12);
  }
  const double at_horizon = SunFactor(Vec3{0.0, 0.0, 1.0}, Vec3{1.0, 0.0, 0.0}, radius);
  EXPECT_NEAR(at_horizon, 2.0 / (3.0 * pi) * radius, 1e-4 * radius);  // half a disk of small s
}

}  // namespace
}  // namespace lightcal
