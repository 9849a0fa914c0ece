// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/axial_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightcal/photometry/area_illuminance.h"

namespace lightcal {
namespace {

using std::numbers::pi;

SourceSize DiskOf(double diameter_m) {
  SourceSize size;
  size.diameter = Metres(diameter_m);
  return size;
}
SourceSize RectOf(double width_m, double height_m) {
  SourceSize size;
  size.width = Metres(width_m);
  size.height = Metres(height_m);
  return size;
}
SourceSize TubeOf(double length_m, double radius_m) {
  SourceSize size;
  size.length = Metres(length_m);
  size.radius = Metres(radius_m);
  return size;
}

TEST(AxialShape, AgreesWithTheClosedFormsOfPhotometryAtEveryDistance) {
  const AxialShape disk = AxialShapeOf(LightKind::kDisk, DiskOf(0.6));
  const AxialShape rect = AxialShapeOf(LightKind::kRect, RectOf(0.6, 1.2));
  for (const double d : {0.01, 0.1, 0.5, 1.0, 3.0, 30.0, 3000.0}) {
    const double d2 = d * d;
    EXPECT_NEAR(AxialShapeFactor(disk, d),
                d2 * LuxPerNitOfDisk(Metres(0.3), Metres(d)) / (pi * 0.09), 1e-12);
    EXPECT_NEAR(AxialShapeFactor(rect, d),
                d2 * LuxPerNitOfRect(Metres(0.6), Metres(1.2), Metres(d)) / 0.72, 1e-12);
  }
}

TEST(AxialShape, ThinTubeAgreesWithTheCylinderItApproximates) {
  // A thin line errs by at most 0.85 R/d against the true cylinder.
  const AxialShape tube = AxialShapeOf(LightKind::kTube, TubeOf(1.2, 0.013));
  for (const double d : {0.3, 1.0, 4.0}) {
    const double exact =
        d * d * LuxPerNitOfTube(Metres(1.2), Metres(0.013), Metres(d)) / (2.0 * 0.013 * 1.2);
    EXPECT_NEAR(AxialShapeFactor(tube, d) / exact, 1.0, 0.85 * 0.013 / d);
  }
}

TEST(AxialShape, FalloffsDerivativesAreThoseThatFiniteDifferencesShow) {
  for (const AxialShape& shape : {AxialShape{}, AxialShapeOf(LightKind::kDisk, DiskOf(0.6)),
                                  AxialShapeOf(LightKind::kRect, RectOf(0.6, 1.2)),
                                  AxialShapeOf(LightKind::kTube, TubeOf(1.2, 0.013))}) {
    const auto value = [&](double r) { return AxialShapeFactor(shape, r) / (r * r); };
    for (const double r : {0.05, 0.3, 1.0, 4.0, 40.0}) {
      const AxialFalloff at = AxialFalloffAt(shape, r);
      EXPECT_NEAR(at.value / value(r), 1.0, 1e-14);
      const double h = 1e-4 * r;
      EXPECT_NEAR(at.slope / ((value(r + h) - value(r - h)) / (2.0 * h)), 1.0, 1e-7);
      const auto slope = [&](double s) { return AxialFalloffAt(shape, s).slope; };
      EXPECT_NEAR(at.bend / ((slope(r + h) - slope(r - h)) / (2.0 * h)), 1.0, 1e-7);
    }
  }
}

TEST(AxialShape, DiskAtFiveDiametersIsOnePercentBelowThePoint) {
  const AxialShape disk = AxialShapeOf(LightKind::kDisk, DiskOf(1.0));
  EXPECT_NEAR(1.0 / AxialShapeFactor(disk, 5.0) - 1.0, 0.01, 1e-12);
}

TEST(AxialShape, FarAwayEverySourceIsAPoint) {
  for (const AxialShape& shape : {AxialShape{AxialShape::Outline::kDisk, 0.5, 0.0},
                                  AxialShape{AxialShape::Outline::kRect, 0.5, 0.3},
                                  AxialShape{AxialShape::Outline::kTube, 0.5, 0.0}}) {
    EXPECT_NEAR(AxialShapeFactor(shape, 1e5), 1.0, 1e-10);
  }
}

TEST(AxialShape, SourcesWithoutASizeArePoints) {
  EXPECT_EQ(AxialShapeOf(LightKind::kDisk, {}).outline, AxialShape::Outline::kPoint);
  EXPECT_EQ(AxialShapeOf(LightKind::kSphere, DiskOf(1.0)).outline, AxialShape::Outline::kPoint);
}

}  // namespace
}  // namespace lightcal
