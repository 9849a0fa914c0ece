// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lightcal/photometry/half_range.h"

namespace lightcal {
namespace {

TEST(Exposure, OneSecondAtFOneIsEvZero) {
  EXPECT_EQ(Ev({1.0, Seconds(1.0), 100.0}), 0.0);
  EXPECT_EQ(Ev100({1.0, Seconds(1.0), 100.0}), 0.0);
  EXPECT_EQ(MaximumLuminance({1.0, Seconds(1.0), 100.0}).value(), 1.2);
}

// "Sunny 16": f/16 at 1/S seconds in full sun is EV100 15 (ANSI PH2.7).
TEST(Exposure, SunnySixteenIsEvFifteen) {
  EXPECT_NEAR(Ev100({16.0, Seconds(1.0 / 125.0), 125.0}), 14.65, 0.01);
  EXPECT_NEAR(Ev100FromIlluminance(Lux(81920.0)), 15.0, 1e-12);
  EXPECT_NEAR(Ev100FromLuminance(Nits(4096.0)), 15.0, 1e-12);
}

TEST(Exposure, EvIsApertureValuePlusTimeValue) {
  const CameraSettings camera{2.8, Seconds(1.0 / 48.0), 800.0};
  EXPECT_NEAR(Ev(camera), ApertureValue(2.8) + TimeValue(Seconds(1.0 / 48.0)), 1e-15);
  EXPECT_NEAR(Ev(camera), std::log2(2.8 * 2.8 * 48.0), 1e-12);
  EXPECT_NEAR(Ev100(camera), Ev(camera) - 3.0, 1e-12);
}

TEST(Exposure, AHalfOpenShutterAt24FramesIsA48thOfASecond) {
  EXPECT_NEAR(ShutterFromAngle(RadiansFromDegrees(180.0), 24.0).value(), 1.0 / 48.0, 1e-17);
}

// ISO 12232:2006 gives 0.65 for T = 0.9, v = 0.98, 10 degrees off the axis.
TEST(Exposure, TheUsualLensHasTheConstantOfTheStandard) {
  EXPECT_NEAR(LensConstant({}), 0.65, 0.002);
  EXPECT_NEAR(LensConstant({1.0, 1.0, Radians(0.0)}), std::numbers::pi / 4.0, 1e-15);
  EXPECT_NEAR(LensConstant({1.0, 1.0, RadiansFromDegrees(60.0)}), std::numbers::pi / 64.0, 1e-15);
}

// Independent law: a Lambertian scene seen by a perfect lens, E = pi L/4 / N^2 (small aperture).
TEST(Exposure, APerfectLensGivesTheCameraEquation) {
  const CameraSettings camera{8.0, Seconds(0.5), 100.0};
  const double q = LensConstant({1.0, 1.0, Radians(0.0)});
  EXPECT_NEAR(SensorExposure(Nits(1000.0), camera, q).value,
              std::numbers::pi * 1000.0 / 4.0 / 64.0 * 0.5, 1e-12);
}

TEST(Exposure, TheSaturatingLuminanceMapsToOne) {
  const CameraSettings camera{5.6, Seconds(1.0 / 250.0), 640.0};
  for (const double q : {0.4, 0.65}) {
    EXPECT_NEAR(MaximumLuminance(camera, q).value() * ExposureScale(camera, q), 1.0, 1e-15);
    EXPECT_NEAR(SensorExposure(MaximumLuminance(camera, q), camera, q).value, 78.0 / 640.0, 1e-15);
  }
}

TEST(HalfRange, ClassesMeetAtTheEdgesOfBinary16) {
  EXPECT_EQ(ClassifyHalf(0.0), HalfRange::kFits);
  EXPECT_EQ(ClassifyHalf(-65504.0), HalfRange::kFits);
  EXPECT_EQ(ClassifyHalf(65504.01), HalfRange::kOverflow);
  EXPECT_EQ(ClassifyHalf(0x1p-14), HalfRange::kFits);
  EXPECT_EQ(ClassifyHalf(std::nextafter(0x1p-14, 0.0)), HalfRange::kSubnormal);
  EXPECT_EQ(ClassifyHalf(0x1p-24), HalfRange::kSubnormal);
  EXPECT_EQ(ClassifyHalf(0x1p-25), HalfRange::kUnderflow);
  EXPECT_EQ(ClassifyHalf(std::nextafter(0x1p-25, 1.0)), HalfRange::kSubnormal);
  EXPECT_EQ(ClassifyHalf(std::numeric_limits<double>::infinity()), HalfRange::kOverflow);
  EXPECT_EQ(ClassifyHalf(std::numeric_limits<double>::quiet_NaN()), HalfRange::kOverflow);
}

// The compiler's own half float as the independent law.
TEST(HalfRange, AgreesWithTheHardwareFormat) {
  for (double exponent = -27.0; exponent < 18.0; exponent += 0.0625) {
    const double value = std::exp2(exponent);
    const auto half = static_cast<double>(static_cast<_Float16>(value));
    const HalfRange range = ClassifyHalf(value);
    EXPECT_EQ(range == HalfRange::kUnderflow, half == 0.0) << value;
    if (range == HalfRange::kFits) {
      EXPECT_NEAR(half / value, 1.0, 0x1p-11) << value;
    }
    if (std::isinf(half)) {
      EXPECT_EQ(range, HalfRange::kOverflow) << value;
    }
  }
}

}  // namespace
}  // namespace lightcal
