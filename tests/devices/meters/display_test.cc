// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightcal::devices {
namespace {

TEST(Display, ADecimalNumberIsItself) {
  EXPECT_EQ(LuxFromDisplay({1234, 1, false}), 123.4);
  EXPECT_EQ(LuxFromDisplay({1999, 2, false}), 19.99);
  EXPECT_EQ(LuxFromDisplay({1234, 0, false}), 1234.0);
  EXPECT_EQ(LuxFromDisplay({1234, -2, false}), 123400.0);
}

TEST(Display, AFootCandleIsALumenPerSquareFoot) {
  EXPECT_NEAR(LuxFromDisplay({100, 1, true}), 10.0 / (0.3048 * 0.3048), 1e-12);
}

// The variance of a uniform error one digit wide is digit^2 / 12.
TEST(Display, TheDigitWidensSigmaWhereItIsCoarse) {
  EXPECT_NEAR(SigmaOfDisplay({1000, 1, false}, 0.03), 0.03, 1e-5);
  const double coarse = SigmaOfDisplay({2, 0, false}, 0.03);
  EXPECT_NEAR(coarse * coarse, 0.03 * 0.03 + 0.25 / 12.0, 1e-12);
  EXPECT_GT(SigmaOfDisplay({1, 0, false}, 0.03), coarse);
}

TEST(Display, ZeroHasAWideButFiniteSigma) {
  const double sigma = SigmaOfDisplay({0, 1, false}, 0.03);
  EXPECT_GT(sigma, 0.9);
  EXPECT_LT(sigma, 1.0);
}

TEST(Display, AValueBeyondTheHighestRangeIsCensoredAtItsEnd) {
  const DisplayLimits limits{0.05, 20000.0};
  const auto inside = ReadingFromDisplay({2000, -1, false}, limits, "m:1").reading;
  EXPECT_FALSE(inside.over_range);
  EXPECT_EQ(inside.illuminance->value(), 20000.0);
  EXPECT_EQ(inside.quality, MeterQuality::kPhotometer);
  EXPECT_EQ(inside.device, "m:1");
  const auto beyond = ReadingFromDisplay({2001, -1, false}, limits, "m:1").reading;
  EXPECT_TRUE(beyond.over_range);
  EXPECT_EQ(beyond.illuminance->value(), 20000.0);
  EXPECT_EQ(*beyond.sigma_relative, 0.05);
}

}  // namespace
}  // namespace lightcal::devices
