// SPDX-License-Identifier: Apache-2.0
// The indices of glare by hand, and the limits they must keep.
#include "lightcal/photometry/glare_indices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace lightcal {
namespace {

Vec3 At(double from_axis_deg, double from_up_deg) {
  const double s = from_axis_deg * std::numbers::pi / 180.0;
  const double t = from_up_deg * std::numbers::pi / 180.0;
  return {std::sin(s) * std::sin(t), std::cos(s), std::sin(s) * std::cos(t)};
}

TEST(PositionIndices, AreOneAheadAndGrowAwayFromIt) {
  EXPECT_NEAR(PositionIndex({0, 1, 0}), 1.0, 1e-12);
  for (const double t : {0.0, 30.0, 60.0, 90.0, 135.0, 180.0}) {
    double before = 1.0;
    for (double s = 5.0; s < 70.0; s += 5.0) {
      const double p = PositionIndex(At(s, t));
      EXPECT_GT(p, before - 1e-9) << s << " " << t;
      EXPECT_LE(p, 16.0);
      before = p;
      EXPECT_NEAR(p, PositionIndex(At(s, -t)), 1e-9);  // left as right
    }
  }
}

// Straight above, t = 0: exp((35.2 - 1.22) s/1000 + 21 s^2/1e5). Straight below: 1 + .8 tan s.
TEST(PositionIndices, AreGuthsAboveAndIwatasBelow) {
  EXPECT_NEAR(PositionIndex(At(20, 0)), std::exp(33.98 * 0.02 + 21.0 * 400.0 / 1e5), 1e-9);
  EXPECT_NEAR(PositionIndex(At(20, 180)), 1.0 + 0.8 * std::tan(20 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(PositionIndex(At(45, 180)), 1.0 + 1.2, 1e-9);
  EXPECT_NEAR(PositionIndex(At(85, 180)), 1.0 + 1.2 * 3.0, 1e-9);
}

TEST(GlareIndices, OfOneSourceAreTheFormulas) {
  const GlareLight light{Lux(1500.0), Lux(500.0)};
  EXPECT_NEAR(light.background().value(), 1000.0 / std::numbers::pi, 1e-12);
  const std::vector<GlareSource> one = {{Nits(20000.0), Steradians(0.02), 2.0}};
  const double sum = 1e4 * 1e4 * 0.02;
  EXPECT_NEAR(*UnifiedGlareRating(light, one),
              8.0 * std::log10(0.25 * sum * std::numbers::pi / 1000.0), 1e-12);
  EXPECT_NEAR(*CieGlareIndex(light, one), 8.0 * std::log10(2.0 * 2.0 / 1500.0 * sum), 1e-12);
  EXPECT_NEAR(DaylightGlareProbability(light, one, true),
              5.87e-5 * 1500.0 + 0.0918 * std::log10(1.0 + sum / std::pow(1500.0, 1.87)) + 0.16,
              1e-12);
  const double dgi = 0.478 * std::pow(20000.0, 1.6) * std::pow(0.02 / 4.0, 0.8) /
                     (1000.0 / std::numbers::pi + 0.07 * std::sqrt(0.02) * 20000.0);
  EXPECT_NEAR(*DaylightGlareIndex(light, one), 10.0 * std::log10(dgi), 1e-12);
}

// Two halves of a source are the source to UGR, CGI and DGP (not to DGI).
TEST(GlareIndices, AddWhatSourcesDo) {
  const GlareLight light{Lux(1500.0), Lux(500.0)};
  const std::vector<GlareSource> whole = {{Nits(20000.0), Steradians(0.02), 2.0}};
  const std::vector<GlareSource> halves(2, {Nits(20000.0), Steradians(0.01), 2.0});
  EXPECT_NEAR(*UnifiedGlareRating(light, whole), *UnifiedGlareRating(light, halves), 1e-12);
  EXPECT_NEAR(*CieGlareIndex(light, whole), *CieGlareIndex(light, halves), 1e-12);
  EXPECT_NEAR(DaylightGlareProbability(light, whole, true),
              DaylightGlareProbability(light, halves, true), 1e-12);
}

TEST(GlareIndices, SayNothingWithoutSourcesOrLight) {
  const GlareLight light{Lux(1500.0), Lux(0.0)};
  EXPECT_FALSE(UnifiedGlareRating(light, {}));
  EXPECT_FALSE(DaylightGlareIndex(light, {}));
  EXPECT_FALSE(CieGlareIndex(light, {}));
  EXPECT_NEAR(DaylightGlareProbability(light, {}, true), 0.16 + 5.87e-5 * 1500.0, 1e-12);
  EXPECT_EQ(DaylightGlareProbability({Lux(0.0), Lux(0.0)}, {}, true), 0.0);
  const std::vector<GlareSource> sun = {{Nits(1e9), Steradians(6e-5), 1.0}};
  EXPECT_EQ(DaylightGlareProbability({Lux(60000.0), Lux(50000.0)}, sun, true), 1.0);
  // In the dark the correction takes it to nothing.
  EXPECT_LT(DaylightGlareProbability({Lux(1.0), Lux(0.0)}, {}, true), 0.005);
}

}  // namespace
}  // namespace lightcal
