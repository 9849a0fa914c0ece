// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/summary.h"

#include <gmock/gmock.h>

namespace lightcal {
namespace {

std::vector<MeterReading> Series(const std::vector<double>& lux) {
  std::vector<MeterReading> series;
  for (const double value : lux) {
    MeterReading m;
    m.reading.illuminance = Lux(value);
    m.reading.sigma_relative = 0.05;
    m.reading.cct = Kelvin(value);  // tells which measurement was kept
    series.push_back(m);
  }
  return series;
}

bool Drifts(const std::vector<double>& lux) {
  const auto summary = Summarise(Series(lux));
  return std::ranges::any_of(summary->kept.warnings,
                             [](const Warning& w) { return w.code == "drift"; });
}

TEST(Summary, TheMedianIsKeptWithTheColorOfTheNearestMeasurement) {
  const auto odd = Summarise(Series({100.0, 900.0, 102.0}));
  EXPECT_EQ(odd->kept.reading.illuminance->value(), 102.0);
  EXPECT_EQ(odd->kept.reading.cct->value(), 102.0);
  const auto even = Summarise(Series({100.0, 101.0, 103.0, 110.0}));
  EXPECT_EQ(even->kept.reading.illuminance->value(), 102.0);
  EXPECT_EQ(even->kept.reading.cct->value(), 101.0);
}

TEST(Summary, SpreadIsTheScaledMadAndSigmaIsTheLargerOfItAndTheMeters) {
  // |E_i - 100| = 20 10 0 10 20: MAD 10, so the spread is 14.826 %.
  const auto wide = Summarise(Series({120.0, 90.0, 100.0, 110.0, 80.0}));
  EXPECT_NEAR(wide->spread_relative, 0.14826, 1e-12);
  EXPECT_NEAR(*wide->kept.reading.sigma_relative, 0.14826, 1e-12);
  const auto narrow = Summarise(Series({100.0, 100.1, 99.9}));
  EXPECT_LT(narrow->spread_relative, 0.05);
  EXPECT_EQ(*narrow->kept.reading.sigma_relative, 0.05);
}

TEST(Summary, OneMeasurementIsItsOwnSummary) {
  const auto one = Summarise(Series({192.0}));
  EXPECT_EQ(one->count, 1);
  EXPECT_EQ(one->spread_relative, 0.0);
  EXPECT_EQ(one->kept.reading.illuminance->value(), 192.0);
}

TEST(Summary, DarknessHasNoRelativeSpread) {
  const auto dark = Summarise(Series({0.0, 0.0, 0.0}));
  EXPECT_EQ(dark->spread_relative, 0.0);
  EXPECT_EQ(*dark->kept.reading.sigma_relative, 0.05);
}

TEST(Summary, NothingMeasuredHasNoSummary) {
  EXPECT_FALSE(Summarise({}));
  EXPECT_FALSE(Summarise(std::vector<MeterReading>(2)));
}

TEST(Summary, AWarmingLampDriftsAndANoisyOneDoesNot) {
  EXPECT_TRUE(Drifts({100.0, 101.1, 101.9, 103.0, 104.1}));
  EXPECT_FALSE(Drifts({100.0, 101.0, 99.0, 101.0, 100.0}));
  EXPECT_FALSE(Drifts({100.0, 100.02, 100.04, 100.06, 100.08}));  // too small to matter
  EXPECT_FALSE(Drifts({100.0, 104.0}));                           // too few to tell
}

}  // namespace
}  // namespace lightcal
