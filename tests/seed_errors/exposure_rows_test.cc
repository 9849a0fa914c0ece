// SPDX-License-Identifier: Apache-2.0
// The seed's errors about cameras (its chapters 3 and 7); rows.txt lists them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lightcal/photometry/exposure.h"
#include "lightcal/photometry/half_range.h"

namespace lightcal {
namespace {

CameraSettings Camera(double f_number, double seconds, double iso = 100.0) {
  return {f_number, Seconds(seconds), iso};
}

TEST(SeedErrors, SensorExposureFallsWithTheSquareOfTheFNumber) {
  const double seed = 0.65 * 0.01 / 4.0 * 1000.0;
  const double ours = SensorExposure(Nits(1000.0), Camera(4.0, 0.01)).value;
  EXPECT_DOUBLE_EQ(ours, 0.65 * 0.01 * 1000.0 / 16.0);
  EXPECT_DOUBLE_EQ(seed / ours, 4.0);
  // What just saturates does so through N^2 as well.
  const CameraSettings camera = Camera(4.0, 0.01, 200.0);
  EXPECT_NEAR(SensorExposure(MaximumLuminance(camera), camera).value,
              SaturatingExposure(200.0).value, 1e-15);
}

TEST(SeedErrors, OneMoreEvHalvesTheLightOnTheSensor) {
  const CameraSettings before = Camera(4.0, 1.0 / 60.0);
  const CameraSettings after = Camera(4.0, 1.0 / 120.0);
  EXPECT_DOUBLE_EQ(Ev(after) - Ev(before), 1.0);
  const double ours =
      SensorExposure(Nits(100.0), after).value / SensorExposure(Nits(100.0), before).value;
  EXPECT_DOUBLE_EQ(ours, 0.5);
  EXPECT_NE(ours, 2.0);  // the seed
}

TEST(SeedErrors, OneMoreEv100NeedsTwiceTheSceneLuminanceAtAnySpeed) {
  for (const double iso : {50.0, 100.0, 800.0}) {
    const CameraSettings before = Camera(2.8, 1.0 / 50.0, iso);
    const CameraSettings after = Camera(2.8, 1.0 / 100.0, iso);
    EXPECT_NEAR(Ev100(after) - Ev100(before), 1.0, 1e-12);
    EXPECT_NEAR(Ev100(before), Ev(before) - std::log2(iso / 100.0), 1e-12);
    EXPECT_DOUBLE_EQ(MaximumLuminance(after) / MaximumLuminance(before), 2.0);
    // The same scene comes out half as bright; the seed says twice.
    EXPECT_DOUBLE_EQ(ExposureScale(after) / ExposureScale(before), 0.5);
  }
}

TEST(SeedErrors, FTwoIsApertureValueTwo) {
  EXPECT_DOUBLE_EQ(ApertureValue(2.0), 2.0);
  EXPECT_NE(ApertureValue(2.0), 1.0);  // the seed
  EXPECT_NEAR(ApertureValue(std::numbers::sqrt2), 1.0, 1e-15);
  EXPECT_NEAR(ApertureValue(2.0 * std::numbers::sqrt2), 3.0, 1e-15);
}

TEST(SeedErrors, DoublingTheExposureTimeTakesOneEvAway) {
  EXPECT_DOUBLE_EQ(TimeValue(Seconds(1.0 / 60.0)) - TimeValue(Seconds(1.0 / 30.0)), 1.0);
  const double ours = Ev(Camera(4.0, 2.0)) - Ev(Camera(4.0, 1.0));
  EXPECT_DOUBLE_EQ(ours, -1.0);
  EXPECT_NE(ours, 1.0);  // "shutter x2 is EV+1", read of the time
}

TEST(SeedErrors, AnFNumberRootTwoLargerHalvesTheArea) {
  const Metres wide = PupilDiameter(Metres(0.05), 2.0);
  const Metres narrow = PupilDiameter(Metres(0.05), 2.0 * std::numbers::sqrt2);
  EXPECT_NEAR(narrow / wide, 1.0 / std::numbers::sqrt2, 1e-15);
  EXPECT_LT(narrow / wide, 1.0);  // the seed: twice
  EXPECT_NEAR((narrow / wide) * (narrow / wide), 0.5, 1e-15);
  EXPECT_NEAR(SensorExposure(Nits(1.0), Camera(2.0 * std::numbers::sqrt2, 1.0)).value /
                  SensorExposure(Nits(1.0), Camera(2.0, 1.0)).value,
              0.5, 1e-15);
}

TEST(SeedErrors, TheFNumberIsARatioThatGrowsAsTheHoleShrinks) {
  const double seed = 0.025;  // "the aperture diameter value"
  EXPECT_DOUBLE_EQ(FNumber(Metres(0.05), Metres(0.025)), 2.0);
  EXPECT_NE(FNumber(Metres(0.05), Metres(0.025)), seed);
  EXPECT_GT(FNumber(Metres(0.05), Metres(0.0125)), FNumber(Metres(0.05), Metres(0.025)));
  EXPECT_DOUBLE_EQ(PupilDiameter(Metres(0.05), 4.0).value(), 0.0125);
}

TEST(SeedErrors, ALongerLensOfTheSameHoleIsDarker) {
  const auto exposure = [](double focal_length, double diameter) {
    return SensorExposure(Nits(100.0),
                          Camera(FNumber(Metres(focal_length), Metres(diameter)), 0.01))
        .value;
  };
  EXPECT_DOUBLE_EQ(exposure(0.100, 0.025) / exposure(0.050, 0.025), 0.25);
  EXPECT_DOUBLE_EQ(exposure(0.100, 0.050) / exposure(0.050, 0.025), 1.0);
}

TEST(SeedErrors, MaximumLuminanceCountsTheSpeedOnce) {
  const auto seed = [](const CameraSettings& camera) {
    return std::exp2(Ev100(camera)) * 78.0 / (0.65 * camera.iso);
  };
  const CameraSettings base = Camera(4.0, 1.0 / 60.0, 100.0);
  const CameraSettings fast = Camera(4.0, 1.0 / 60.0, 400.0);
  EXPECT_NEAR(MaximumLuminance(base).value(), seed(base), 1e-9);  // the one case that agrees
  EXPECT_NEAR(MaximumLuminance(base).value(), 1.2 * std::exp2(Ev100(base)), 1e-9);
  EXPECT_NEAR(MaximumLuminance(fast).value(), 78.0 / (0.65 * 400.0) * 16.0 * 60.0, 1e-9);
  EXPECT_NEAR(seed(fast) / MaximumLuminance(fast).value(), 0.25, 1e-12);
}

TEST(SeedErrors, ItIsTheHalfFloatThatTheSunOverflows) {
  constexpr double kSun = 1.6e9;
  EXPECT_LT(kSun, static_cast<double>(std::numeric_limits<float>::max()));
  EXPECT_TRUE(std::isfinite(static_cast<float>(kSun)));
  EXPECT_EQ(ClassifyHalf(kSun), HalfRange::kOverflow);
  EXPECT_EQ(ClassifyHalf(65504.0), HalfRange::kFits);
  EXPECT_EQ(ClassifyHalf(65505.0), HalfRange::kOverflow);
}

TEST(SeedErrors, PreExposureAloneDoesNotMakeTheSunFit) {
  // f/16 at EV100 14 and 15: t = 16^2 / 2^EV.
  const double at_ev14 = PreExposed(2e9, ExposureScale(Camera(16.0, 256.0 / 16384.0)));
  const double at_ev15 = PreExposed(2e9, ExposureScale(Camera(16.0, 256.0 / 32768.0)));
  EXPECT_NEAR(at_ev14, 101725.0, 1.0);
  EXPECT_NEAR(at_ev15, 50863.0, 1.0);
  EXPECT_EQ(ClassifyHalf(at_ev14), HalfRange::kOverflow);
  EXPECT_EQ(ClassifyHalf(at_ev15), HalfRange::kFits);
}

}  // namespace
}  // namespace lightcal
