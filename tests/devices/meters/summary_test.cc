// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/summary.h"

#include <gmock/gmock.h>

#include <cmath>

namespace lightcal::devices {
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

bool Warns(const std::vector<MeterReading>& series, std::string_view code) {
  const auto summary = Summarise(series);
  return std::ranges::any_of(summary->kept.warnings,
                             [&](const Warning& w) { return w.code == code; });
}

TEST(Summary, LightThatJumpsIsSeenThoughMostOfItIsAtOneValue) {
  // |E_i - 100| = 0 200 0 0 200: mean 80, their middle 0.
  const auto jumping = Series({100.0, 300.0, 100.0, 100.0, 300.0});
  EXPECT_NEAR(Summarise(jumping)->spread_relative, 1.2533 * 0.8, 1e-12);
  EXPECT_NEAR(*Summarise(jumping)->kept.reading.sigma_relative, 1.2533 * 0.8, 1e-12);
  EXPECT_TRUE(Warns(jumping, "flicker"));
  EXPECT_TRUE(Warns(Series({100.0, 101.0, 300.0, 99.0, 301.0, 100.0}), "flicker"));
  // One stray, and digits that repeat.
  EXPECT_EQ(Summarise(Series({100.0, 100.0, 300.0, 100.0, 100.0}))->spread_relative, 0.0);
  for (const auto& steady :
       {Series({192.0, 192.0, 192.1, 192.0, 192.1}), Series({5.0, 5.0, 5.0, 5.0, 5.0})}) {
    EXPECT_EQ(Summarise(steady)->spread_relative, 0.0);
    EXPECT_FALSE(Warns(steady, "flicker"));
  }
}

TEST(Summary, OverRangeCountsAsBrighterThanEveryNumber) {
  auto series = Series({100.0, 101.0, 102.0});
  series[0].reading.over_range = true;  // shown 100, the end of its range
  const auto two_in_range = Summarise(series);
  EXPECT_EQ(two_in_range->kept.reading.illuminance->value(), 102.0);
  EXPECT_FALSE(two_in_range->kept.reading.over_range);
  series[1].reading.over_range = true;
  const auto mostly_over = Summarise(series);
  EXPECT_TRUE(mostly_over->kept.reading.over_range);
  EXPECT_EQ(mostly_over->kept.reading.illuminance->value(), 100.0)
      << "the limit, as the meter said";
  EXPECT_EQ(mostly_over->spread_relative, 0.0);
}

TEST(Summary, UnderRangeCountsAsDarkerThanEveryNumber) {
  auto series = Series({1.0, 1.0, 1.2, 1.4});
  series[0].reading.under_range = series[1].reading.under_range = true;
  EXPECT_EQ(Summarise(series)->kept.reading.illuminance->value(), 1.2);
  series[2].reading.under_range = true;
  EXPECT_TRUE(Summarise(series)->kept.reading.under_range);
}

TEST(Summary, ScatterWithoutTrendIsFlicker) {
  EXPECT_TRUE(Warns(Series({100.0, 106.0, 95.0, 104.0, 94.0, 105.0}), "flicker"));
  EXPECT_FALSE(Warns(Series({100.0, 100.6, 99.5, 100.4, 99.4, 100.5}), "flicker"));
  EXPECT_FALSE(Warns(Series({100.0, 110.0, 120.0, 130.0, 140.0}), "flicker")) << "that is drift";
}

// A lamp warming up as 1 - exp(-t/tau)/10: the change over six readings of spacing h at time t is
// exp(-t/tau) (1 - exp(-5h/tau))/10 for values near 1.
TEST(Summary, ALampHasSettledWhenSixReadingsNoLongerClimb) {
  std::vector<double> values;
  std::size_t settled_after = 0;
  for (int i = 0; i < 100 && settled_after == 0; ++i) {
    values.push_back(1000.0 * (1.0 - 0.1 * std::exp(-i / 10.0)));
    if (HasSettled(values, 0.005)) settled_after = values.size();
  }
  // 0.1 exp(-t/10) 0.393 < 0.005 from t = 20.6: six readings that begin at the 22nd end at the 27th
  // at the latest; along the least-squares line the change is a little less than from end to end.
  EXPECT_GE(settled_after, 25U);
  EXPECT_LE(settled_after, 27U);
  EXPECT_FALSE(HasSettled(std::vector<double>(5, 100.0), 0.005));
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
}  // namespace lightcal::devices
