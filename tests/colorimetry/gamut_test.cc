// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/gamut.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lightcal/colorimetry/cct.h"

namespace lightcal {
namespace {

Rgb Candle() {  // outside sRGB
  return LinearSrgbFromXyz(XyzFromXyAtUnitY(XyFromCct(Kelvin(1500))));
}

TEST(Gamut, KeepingLeavesNegativeComponents) {
  EXPECT_FALSE(IsInGamut(Candle()));
  EXPECT_EQ(FitToGamut(Candle(), RgbSpace::kSrgb, GamutPolicy::kKeep).b, Candle().b);
}

TEST(Gamut, ClippingOnlyTouchesNegativeComponents) {
  const Rgb c = FitToGamut(Candle(), RgbSpace::kSrgb, GamutPolicy::kClip);
  EXPECT_EQ(c.b, 0.0);
  EXPECT_EQ(c.r, Candle().r);
  EXPECT_GT(LuminanceOfRgb(c, RgbSpace::kSrgb), 1.0 + 1e-6);
}

TEST(Gamut, DesaturatingKeepsLuminanceAndTheDirectionFromWhite) {
  const Rgb from = Candle();
  const Rgb c = FitToGamut(from, RgbSpace::kSrgb, GamutPolicy::kDesaturate);
  EXPECT_NEAR(std::min({c.r, c.g, c.b}), 0.0, 1e-15);
  EXPECT_NEAR(LuminanceOfRgb(c, RgbSpace::kSrgb), 1.0, 1e-12);
  EXPECT_NEAR((c.r - 1.0) / (from.r - 1.0), (c.g - 1.0) / (from.g - 1.0), 1e-12);
}

TEST(Gamut, ColorsInsideStayAsTheyAre) {
  const Rgb inside = {0.5, 1.0, 0.2};
  EXPECT_EQ(FitToGamut(inside, RgbSpace::kAcescg, GamutPolicy::kDesaturate).g, 1.0);
  EXPECT_EQ(FitToGamut(inside, RgbSpace::kAcescg, GamutPolicy::kClip).b, 0.2);
}

}  // namespace
}  // namespace lightcal
