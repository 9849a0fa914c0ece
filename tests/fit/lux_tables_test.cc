// SPDX-License-Identifier: Apache-2.0
// Real lamps, published by their makers: what the fit must find in them.
#include "lux_tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightcal/fit/fit_light.h"

namespace lightcal {
namespace {

using test::LoadLuxTables;
using test::LuxTable;
using test::SessionOf;

std::vector<FittedLight> FitAmaran(const std::string& accessory) {
  std::vector<FittedLight> lights;
  for (const LuxTable& table : LoadLuxTables()) {
    if (table.fixture != "amaran 200x S" || table.accessory != accessory) continue;
    auto fitted = FitSession(SessionOf(table, kDataSheetMeter), FitSettings{});
    EXPECT_TRUE(fitted.has_value());
    lights.push_back(fitted->lights.lights.front());
  }
  EXPECT_EQ(lights.size(), 5U);
  return lights;
}

TEST(LuxTables, BareLampsFollowTheModelWithinTwoAndAHalfPercent) {
  for (const FittedLight& light : FitAmaran("bare")) {
    ASSERT_TRUE(light.fit.rms_relative.has_value());
    EXPECT_LE(*light.fit.rms_relative, 0.025);
    EXPECT_GT(*light.fit.rms_relative, 0.0);
  }
}

TEST(LuxTables, ReflectorLampsFollowTheModelWithinHalfAPercent) {
  for (const FittedLight& light : FitAmaran("Hyper Reflector")) {
    ASSERT_TRUE(light.fit.rms_relative.has_value());
    EXPECT_LE(*light.fit.rms_relative, 0.005);
  }
}

TEST(LuxTables, AgreeWithAnIndependentFitOfTheSameModel) {
  // scipy.optimize.least_squares on ln E with the same priors: 5585 cd and 0.067 m; 30866 cd,
  // -0.061 m.
  const FittedLight bare = FitAmaran("bare").front();
  EXPECT_NEAR(bare.intensity_cd->value, 5585, 5);
  EXPECT_NEAR(bare.distance_offset_m->value, 0.067, 0.001);
  const FittedLight reflector = FitAmaran("Hyper Reflector").front();
  EXPECT_NEAR(reflector.intensity_cd->value, 30866, 30);
  EXPECT_NEAR(reflector.distance_offset_m->value, -0.061, 0.001);
}

TEST(LuxTables, FiveColoursOfOneLampAgreeOnItsDistanceOffset) {
  for (const char* accessory : {"bare", "Hyper Reflector"}) {
    const std::vector<FittedLight> lights = FitAmaran(accessory);
    for (const FittedLight& a : lights) {
      for (const FittedLight& b : lights) {
        EXPECT_LE(std::abs(a.distance_offset_m->value - b.distance_offset_m->value),
                  a.distance_offset_m->u95);
      }
      EXPECT_EQ(a.fit.learned, (std::vector<std::string>{"intensity", "distance_offset"}));
      EXPECT_EQ(a.fit.degrees_of_freedom, 1);
    }
  }
}

TEST(LuxTables, TwoDistancesPredictTheThirdWithinAHonestInterval) {
  int covered = 0;
  int tables = 0;
  for (const LuxTable& table : LoadLuxTables()) {
    auto fitted = FitSession(SessionOf(table, "", 2), FitSettings{});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    auto predicted = PredictIlluminance(fitted->lights.lights.front(),
                                        Metres(table.distances_m.back()), kSigmaUnnamedMeter);
    ASSERT_TRUE(predicted.has_value());
    const Uncertain& reading = predicted->reading_lx;
    EXPECT_LE(reading.u95 / reading.value, 0.16) << table.fixture << " " << table.accessory;
    const double published = table.illuminances_lx.back();
    covered += published >= *reading.low && published <= *reading.high ? 1 : 0;
    ++tables;
  }
  EXPECT_EQ(tables, 19);
  EXPECT_GE(covered, 18);
}

}  // namespace
}  // namespace lightcal
