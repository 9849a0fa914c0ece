// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/panorama.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace lightcal {
namespace {

using std::numbers::pi;

PixelSolidAngles Angles(Projection projection, int width, int height, double fov_deg = 0.0) {
  auto angles = PixelSolidAngles::Create({projection, width, height, RadiansFromDegrees(fov_deg)});
  EXPECT_TRUE(angles) << angles.error().message;
  return *angles;
}
struct Sums {
  double solid_angle = 0.0, projected = 0.0;
};
Sums SumOf(const PixelSolidAngles& angles) {
  Sums sums;
  for (int y = 0; y < angles.view().height; ++y) {
    for (int x = 0; x < angles.view().width; ++x) {
      sums.solid_angle += angles.SolidAngle(x, y);
      sums.projected += angles.ProjectedSolidAngle(x, y);
    }
  }
  return sums;
}

// A uniform sky of 1 cd/m^2 lights the ground with pi lux; the sphere has 4 pi sr. At any size:
// pixel centres would give pi(H-1)/H or worse.
TEST(LatLong, TheSphereHasFourPiAndTheSkyPiAtEverySize) {
  for (const int height : {1, 2, 3, 8, 16, 37, 500}) {
    const Sums sums = SumOf(Angles(Projection::kLatLong, 2 * height, height));
    EXPECT_NEAR(sums.solid_angle, 4.0 * pi, 1e-11) << height;
    EXPECT_NEAR(sums.projected, pi, 1e-12) << height;
  }
}

TEST(LatLong, DirectionsRunFromTheZenithAndTurnRight) {
  const PixelSolidAngles angles = Angles(Projection::kLatLong, 360, 180);
  const auto expect = [&](double x, double y, Vec3 d) {
    const Vec3 got = *angles.Direction(x, y);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], d[i], 1e-12) << x << "," << y;
  };
  expect(180, 90, {0, 1, 0});
  expect(270, 90, {1, 0, 0});
  expect(77, 0, {0, 0, 1});
  expect(77, 180, {0, 0, -1});
}

TEST(LatLong, MustBeTwiceAsWideAsHigh) {
  const auto angles = PixelSolidAngles::Create({Projection::kLatLong, 100, 100, {}});
  ASSERT_FALSE(angles);
  EXPECT_EQ(angles.error().code, "bad_view");
}

// A pyramid of a x b full angles: Omega = 4 asin(sin(a/2) sin(b/2)), with tan(b/2) = H/W tan(a/2).
TEST(Rectilinear, TheWholePictureIsAPyramid) {
  for (const double fov : {1.0, 20.0, 60.0, 120.0}) {
    const double a = fov * pi / 360.0;
    const double b = std::atan(40.0 / 60.0 * std::tan(a));
    const Sums sums = SumOf(Angles(Projection::kRectilinear, 60, 40, fov));
    EXPECT_NEAR(sums.solid_angle / (4.0 * std::asin(std::sin(a) * std::sin(b))), 1.0, 1e-9) << fov;
  }
}

// Each pixel against the sum of 100 x 100 points of it: cos^3 dA and cos^4 dA.
TEST(Rectilinear, PixelsAreTheIntegralsOfTheCosineLaws) {
  const PixelSolidAngles angles = Angles(Projection::kRectilinear, 6, 4, 100.0);
  const double f = 3.0 / std::tan(50.0 * pi / 180.0);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(3, 2), std::pair(5, 1)}) {
    double plain = 0.0, cosine = 0.0;
    constexpr int kPoints = 100;
    for (int i = 0; i < kPoints; ++i) {
      for (int j = 0; j < kPoints; ++j) {
        const double px = (x + (i + 0.5) / kPoints - 3.0) / f;
        const double py = (y + (j + 0.5) / kPoints - 2.0) / f;
        const double r2 = 1.0 + px * px + py * py;
        plain += std::pow(r2, -1.5);
        cosine += 1.0 / (r2 * r2);
      }
    }
    const double area = 1.0 / (kPoints * kPoints * f * f);
    EXPECT_NEAR(angles.SolidAngle(x, y), plain * area, 2e-6);
    EXPECT_NEAR(angles.ProjectedSolidAngle(x, y), cosine * area, 2e-6);
  }
}

TEST(Fisheyes, AHemisphereIsTwoPiAndLightsItsPlaneWithPi) {
  for (const Projection projection : {Projection::kEquidistant, Projection::kEquisolid}) {
    const Sums sums = SumOf(Angles(projection, 420, 400, 180.0));
    EXPECT_NEAR(sums.solid_angle / (2.0 * pi), 1.0, 2e-5);
    EXPECT_NEAR(sums.projected / pi, 1.0, 2e-5);
  }
}

// A cone of half angle t: 2 pi (1 - cos t), pi sin^2 t up to 90 degrees and pi beyond.
TEST(Fisheyes, OtherFieldsOfViewAreCones) {
  for (const Projection projection : {Projection::kEquidistant, Projection::kEquisolid}) {
    for (const double fov : {30.0, 120.0, 220.0, 360.0}) {
      const double t = fov * pi / 360.0;
      const Sums sums = SumOf(Angles(projection, 300, 300, fov));
      EXPECT_NEAR(sums.solid_angle / (2.0 * pi * (1.0 - std::cos(t))), 1.0, 3e-5) << fov;
      const double sine = std::sin(std::min(t, pi / 2.0));
      EXPECT_NEAR(sums.projected / (pi * sine * sine), 1.0, 5e-5) << fov;
    }
  }
}

TEST(Fisheyes, PixelsOfAnEquisolidPictureAreEqualAndTheCornersSeeNothing) {
  const PixelSolidAngles angles = Angles(Projection::kEquisolid, 200, 200, 180.0);
  EXPECT_NEAR(angles.SolidAngle(100, 100) / angles.SolidAngle(30, 120), 1.0, 1e-12);
  EXPECT_EQ(angles.SolidAngle(0, 0), 0.0);
  EXPECT_FALSE(angles.Direction(1, 1));
}

TEST(Fisheyes, DirectionsKeepTheirAngleFromTheAxis) {
  const auto angle_at = [](Projection projection, double x) {
    const Vec3 d = *Angles(projection, 200, 200, 180.0).Direction(x, 100.0);
    EXPECT_NEAR(Length(d), 1.0, 1e-12);
    EXPECT_GE(d[0], 0.0);
    return std::acos(std::min(1.0, d[1])) * 180.0 / pi;
  };
  EXPECT_NEAR(angle_at(Projection::kEquidistant, 150.0), 45.0, 1e-9);
  EXPECT_NEAR(angle_at(Projection::kEquidistant, 200.0), 90.0, 1e-9);
  // r/R = sin(t/2)/sin(45 deg): t = 2 asin(.5 sin 45) = 41.41 deg.
  EXPECT_NEAR(angle_at(Projection::kEquisolid, 150.0), 41.4096221, 1e-6);
  EXPECT_NEAR(angle_at(Projection::kEquidistant, 100.0), 0.0, 1e-6);
}

TEST(Views, FieldsOfViewThatNoLensHasAreRefused) {
  const auto code = [](Projection projection, double fov) {
    const auto angles = PixelSolidAngles::Create({projection, 100, 50, RadiansFromDegrees(fov)});
    return angles ? std::string("ok") : angles.error().code;
  };
  EXPECT_EQ(code(Projection::kRectilinear, 0.0), "bad_view");
  EXPECT_EQ(code(Projection::kRectilinear, 180.0), "bad_view");
  EXPECT_EQ(code(Projection::kRectilinear, std::nan("")), "bad_view");
  EXPECT_EQ(code(Projection::kEquidistant, 361.0), "bad_view");
  EXPECT_EQ(code(Projection::kEquisolid, 180.0), "ok");
}

TEST(Views, ProjectionsHaveNames) {
  EXPECT_EQ(ProjectionByName("latlong"), Projection::kLatLong);
  EXPECT_EQ(ProjectionByName("rect"), Projection::kRectilinear);
  EXPECT_EQ(ProjectionByName("equidistant"), Projection::kEquidistant);
  EXPECT_EQ(ProjectionByName("equisolid"), Projection::kEquisolid);
  EXPECT_FALSE(ProjectionByName("mercator"));
}

}  // namespace
}  // namespace lightcal
