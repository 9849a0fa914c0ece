// SPDX-License-Identifier: Apache-2.0
// What engines do to 1/d^2, at ordinary distances and at every edge.
#include "lightcal/photometry/falloff_windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace lightcal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Law {
  std::string name;
  std::function<double(Metres, Metres)> falloff;
  bool window_squared;
  double at_zero;  // per m^2, at d = 0 without range
};
void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }

class EngineFalloff : public testing::TestWithParam<Law> {};

TEST_P(EngineFalloff, IsTheInverseSquareWithoutARangeAtOrdinaryDistances) {
  for (const double d : {0.5, 1.0, 4.0, 100.0}) {
    EXPECT_NEAR(GetParam().falloff(Metres(d), kNoRange) * d * d, 1.0, 4.1e-4) << d;
  }
}

TEST_P(EngineFalloff, LosesWhatItsWindowTakes) {
  // Half way to the range the window keeps 15/16.
  const double kept =
      GetParam().falloff(Metres(2.0), Metres(4.0)) / GetParam().falloff(Metres(2.0), kNoRange);
  const double window = 15.0 / 16.0;
  EXPECT_NEAR(kept, GetParam().window_squared ? window * window : window, 1e-14);
}

TEST_P(EngineFalloff, EndsAtItsRangeWithoutGoingNegative) {
  EXPECT_EQ(GetParam().falloff(Metres(4.0), Metres(4.0)), 0.0);
  EXPECT_EQ(GetParam().falloff(Metres(5.0), Metres(4.0)), 0.0);
  EXPECT_EQ(GetParam().falloff(Metres(kInfinity), Metres(4.0)), 0.0);
  const double before = GetParam().falloff(Metres(4.0 * (1.0 - 1e-16)), Metres(4.0));
  EXPECT_GE(before, 0.0);
  EXPECT_LT(before, 1e-14);
}

TEST_P(EngineFalloff, HasAValueForEveryDistanceAndRange) {
  for (const double d : {0.0, 1e-300, 1e-6, -0.5, 0.5, 1e6, kInfinity}) {
    for (const double r : {0.0, -1.0, 1e-300, 1e-6, 1.0, 1e6, kInfinity}) {
      const double value = GetParam().falloff(Metres(d), Metres(r));
      EXPECT_TRUE(std::isfinite(value)) << d << " " << r;
      EXPECT_GE(value, 0.0) << d << " " << r;
    }
  }
}

TEST_P(EngineFalloff, ReadsNoRangeFromZeroAndBelow) {
  EXPECT_EQ(GetParam().falloff(Metres(2.0), Metres(0.0)),
            GetParam().falloff(Metres(2.0), kNoRange));
  EXPECT_EQ(GetParam().falloff(Metres(2.0), Metres(-1.0)),
            GetParam().falloff(Metres(2.0), kNoRange));
}

TEST_P(EngineFalloff, IsClampedWhereTheLampItselfWouldBe) {
  EXPECT_NEAR(GetParam().falloff(Metres(0.0), kNoRange) / GetParam().at_zero, 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Engines, EngineFalloff,
    testing::Values(
        Law{"Filament", FilamentFalloff, true, 1e4},
        Law{"UnityHdrp", [](Metres d, Metres r) { return UnityHdrpFalloff(d, r); }, true, 1e4},
        Law{"ThreeJs", [](Metres d, Metres r) { return ThreeJsFalloff(d, r); }, true, 100.0},
        Law{"Godot", [](Metres d, Metres r) { return GodotFalloff(d, r); }, true, 1e8},
        Law{"Gltf", GltfFalloff, false, 1e8}, Law{"Unreal", UnrealFalloff, true, 1e4}),
    [](const auto& test) { return test.param.name; });

TEST(FalloffWindows, GodotsDefaultDecayIsNotTheInverseSquare) {
  EXPECT_NEAR(GodotFalloff(Metres(2.0), kNoRange, 1.0), 0.5, 1e-15);
  EXPECT_NEAR(GodotFalloff(Metres(2.0), kNoRange, 2.0), 0.25, 1e-15);
}

TEST(FalloffWindows, ThreeJsClampsAtTenCentimetresWhereOthersDoAtOne) {
  EXPECT_NEAR(ThreeJsFalloff(Metres(0.05), kNoRange), 100.0, 1e-12);
  EXPECT_NEAR(FilamentFalloff(Metres(0.05), kNoRange), 400.0, 1e-12);
}

TEST(FalloffWindows, UnityWithoutRangeAttenuationIsAStep) {
  EXPECT_DOUBLE_EQ(UnityHdrpFalloff(Metres(3.999), Metres(4.0), false), 1.0 / (3.999 * 3.999));
  EXPECT_EQ(UnityHdrpFalloff(Metres(4.0), Metres(4.0), false), 0.0);
}

// The factors of the reference notes on physics, 2.20.
TEST(FalloffWindows, RangeForLossHoldsExactlyThatLoss) {
  const auto factor = [](double loss, WindowPower power) {
    return RangeForLoss(Metres(1.0), loss, power).value();
  };
  EXPECT_NEAR(factor(0.01, WindowPower::kSquared), 3.76, 0.005);
  EXPECT_NEAR(factor(0.01, WindowPower::kPlain), 3.16, 0.005);
  EXPECT_NEAR(factor(0.001, WindowPower::kSquared), 6.69, 0.005);
  EXPECT_NEAR(factor(0.001, WindowPower::kPlain), 5.62, 0.005);
  for (const double loss : {1e-6, 0.01, 0.5}) {
    const Metres r = RangeForLoss(Metres(2.0), loss, WindowPower::kSquared);
    EXPECT_NEAR((1.0 - FilamentFalloff(Metres(2.0), r) * 4.0) / loss, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace lightcal
