// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/exposure_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lightcal {
namespace {

// Errors of labels in percent, from the arithmetic of the dials.
TEST(ExposureGrid, LabelsOfTimeStandForTheKnownPowersOfTwo) {
  EXPECT_DOUBLE_EQ(TimeOfLabel(Seconds(1.0 / 60))->value(), 1.0 / 64);
  EXPECT_DOUBLE_EQ(TimeOfLabel(Seconds(1.0 / 2000))->value(), 1.0 / 2048);
  EXPECT_DOUBLE_EQ(TimeOfLabel(Seconds(30.0))->value(), 32.0);
  EXPECT_DOUBLE_EQ(TimeOfLabel(Seconds(15.0))->value(), 16.0);
  EXPECT_DOUBLE_EQ(TimeOfLabel(Seconds(0.5))->value(), 0.5);
  EXPECT_NEAR(TimeOfLabel(Seconds(1.0 / 50))->value(), std::exp2(-17.0 / 3.0), 1e-12);
  EXPECT_NEAR(TimeOfLabel(Seconds(0.3))->value(), std::exp2(-5.0 / 3.0), 1e-12);
  EXPECT_NEAR(TimeOfLabel(Seconds(1.0 / 45))->value(), std::exp2(-5.5), 1e-12);
}

TEST(ExposureGrid, NoLabelStraysFromItsTimeByMoreThanSevenPercent) {
  int labels = 0;
  for (int speed = 1; speed <= 32000; ++speed) {
    const auto time = TimeOfLabel(Seconds(1.0 / speed));
    if (!time) continue;
    ++labels;
    EXPECT_NEAR(time->value() * speed, 1.0, 0.07) << "1/" << speed;
  }
  EXPECT_GE(labels, 40);
}

TEST(ExposureGrid, ATimeThatNoDialPrintsIsMeantAsItIsWritten) {
  for (const double time :
       {1.0 / 48, 1.0 / 230, 1.0 / 70, 0.9, 7.0, 60.0, 120.0, 1e-9, 0.0, -1.0}) {
    EXPECT_FALSE(TimeOfLabel(Seconds(time))) << time;
  }
}

TEST(ExposureGrid, LabelsOfApertureStandForPowersOfTheSixthRootOfTwo) {
  EXPECT_DOUBLE_EQ(*FNumberOfLabel(8.0), 8.0);
  EXPECT_DOUBLE_EQ(*FNumberOfLabel(5.6), std::exp2(2.5));
  EXPECT_DOUBLE_EQ(*FNumberOfLabel(11.0), std::exp2(3.5));
  EXPECT_DOUBLE_EQ(*FNumberOfLabel(1.4), std::exp2(0.5));
  EXPECT_NEAR(*FNumberOfLabel(13.0), std::exp2(22.0 / 6.0), 1e-12);
  EXPECT_FALSE(FNumberOfLabel(6.2));
  EXPECT_FALSE(FNumberOfLabel(0.0));
}

TEST(ExposureGrid, TheSquareOfALabelledApertureErrsAsPublished) {
  const auto error = [](double label) {
    return label * label / std::pow(*FNumberOfLabel(label), 2) - 1;
  };
  EXPECT_NEAR(error(11), -0.0547, 5e-4);
  EXPECT_NEAR(error(22), -0.0547, 5e-4);
  EXPECT_NEAR(error(13), 0.0479, 5e-4);
  EXPECT_NEAR(error(3.5), -0.0354, 5e-4);
  EXPECT_NEAR(error(2.8), -0.0200, 5e-4);
}

TEST(ExposureGrid, ApexValuesCountOnlyOnTheGrid) {
  EXPECT_DOUBLE_EQ(*ApexOnGrid(6.0), 6.0);
  EXPECT_DOUBLE_EQ(*ApexOnGrid(6.33), 19.0 / 3.0);
  EXPECT_DOUBLE_EQ(*ApexOnGrid(-1.5), -1.5);
  EXPECT_FALSE(ApexOnGrid(std::log2(60.0)));
}

TEST(ExposureGrid, AFiftyMillimetreLensAtOneMetreLosesAnEighthOfAStop) {
  EXPECT_NEAR(*FocusFactor(Metres(0.05), Metres(1.0)), 1.0 / 0.9025, 1e-4);
  EXPECT_NEAR(*FocusFactor(Metres(0.05), Metres(1e6)), 1.0, 1e-6);
  // Magnification 1 at twice the focal length: two stops.
  EXPECT_DOUBLE_EQ(*FocusFactor(Metres(0.1), Metres(0.2)), 4.0);
  EXPECT_FALSE(FocusFactor(Metres(0.1), Metres(0.1)));
  EXPECT_FALSE(FocusFactor(Metres(0.0), Metres(1.0)));
}

}  // namespace
}  // namespace lightcal
