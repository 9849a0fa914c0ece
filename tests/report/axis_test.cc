// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/axis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lightcal::report {
namespace {

using ::testing::ElementsAre;

TEST(AxisMap, ALogAxisGivesEveryDecadeTheSameLength) {
  const Axis axis{AxisScale::kLog, 1.0, 1000.0, 10.0, 310.0};
  EXPECT_DOUBLE_EQ(axis.At(1.0), 10.0);
  EXPECT_DOUBLE_EQ(axis.At(10.0), 110.0);
  EXPECT_DOUBLE_EQ(axis.At(1000.0), 310.0);
}

TEST(AxisTicks, AreRoundNumbers) {
  EXPECT_THAT(TicksOf({AxisScale::kLinear, -2.2, 2.3, 0.0, 300.0}, 60.0),
              ElementsAre(-2.0, -1.0, 0.0, 1.0, 2.0));
  EXPECT_THAT(TicksOf({AxisScale::kLog, 0.4, 60.0, 0.0, 400.0}, 50.0),
              ElementsAre(0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0));
}

TEST(AxisTicks, NeverCrowdAndAreNeverTooFew) {
  for (double factor = 1.02; factor < 1e7; factor *= 1.7) {
    for (const double low : {3e-3, 0.41, 7.3, 912.0}) {
      const Axis axis{AxisScale::kLog, low, low * factor, 64.0, 468.0};
      const auto ticks = TicksOf(axis, 40.0);
      EXPECT_GE(ticks.size(), 2U) << low << " " << factor;
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_GE(ticks[i], axis.low * (1 - 1e-9));
        EXPECT_LE(ticks[i], axis.high * (1 + 1e-9));
        if (i > 0) {
          EXPECT_GE(axis.At(ticks[i]) - axis.At(ticks[i - 1]), 40.0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lightcal::report
