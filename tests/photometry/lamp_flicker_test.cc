// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/lamp_flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightcal/photometry/exposure_grid.h"

namespace lightcal {
namespace {

// Light collected from a square wave, summed in thousandths of a period from every phase.
double WorstBySumming(double frequency_hz, double duty, double time) {
  constexpr int kPhases = 200, kSteps = 10'000;
  double worst = 0.0;
  for (int phase = 0; phase < kPhases; ++phase) {
    double on = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = frequency_hz * time * (i + 0.5) / kSteps + phase / double{kPhases};
      on += t - std::floor(t) < duty ? 1.0 : 0.0;
    }
    worst = std::max(worst, std::abs(on / kSteps / duty - 1.0));
  }
  return worst;
}

TEST(LampFlicker, TheWorstErrorIsThatOfSummedPulses) {
  for (const double duty : {0.1, 0.5, 0.8}) {
    for (const double periods : {0.2, 0.7, 1.5, 3.25, 12.6}) {
      EXPECT_NEAR(WorstFlickerError({100.0, duty}, Seconds(periods / 100.0)),
                  WorstBySumming(100.0, duty, periods / 100.0), 0.004 + 0.005 / duty)
          << duty << " " << periods;
    }
  }
}

// The rule of thumb: (1 - D)/(f t); 200 Hz, half on, 1/30 s: 7.5 %; a thousandth reads 0 or double.
TEST(LampFlicker, StaysBelowTheRuleOfThumbAndReachesIt) {
  double worst = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double periods = 0.01 * i;
    const double error = WorstFlickerError({200.0, 0.5}, Seconds(periods / 200.0));
    EXPECT_LE(error, 0.5 / periods + 1e-12);
    worst = std::max(worst, error * periods / 0.5);
  }
  EXPECT_NEAR(worst, 1.0, 1e-9);
  EXPECT_NEAR(WorstFlickerError({200.0, 0.5}, Seconds(1.0 / 1000.0)), 1.0, 1e-12);
  EXPECT_LE(WorstFlickerError({200.0, 0.5}, Seconds(1.0 / 30.0)), 0.075);
}

TEST(LampFlicker, WholePeriodsAreSafe) {
  for (const int periods : {1, 2, 3, 25}) {
    EXPECT_NEAR(WorstFlickerError({100.0, 0.3}, Seconds(periods / 100.0)), 0.0, 1e-12);
  }
  EXPECT_NEAR(WorstFlickerError({123.0, 1.0}, Seconds(0.0017)), 0.0, 1e-12);
}

TEST(LampFlicker, SafeLabelsAreWhatDialsPrint) {
  const auto safe = FlickerSafeLabels({100.0, 0.5}, 0.03, Seconds(1.0 / 8192.0));
  ASSERT_FALSE(safe.empty());
  EXPECT_DOUBLE_EQ(safe.front().value(), 1.0 / 100.0);
  for (const Seconds label : safe) {
    const auto time = TimeOfLabel(label);
    ASSERT_TRUE(time);
    EXPECT_LE(WorstFlickerError({100.0, 0.5}, *time), 0.03);
  }
  // 1/60 is 2^-6 s on a dial: not one half period of 60 Hz mains but 1.9.
  const auto safe60 = FlickerSafeLabels({120.0, 0.5}, 0.03, Seconds(1.0 / 8192.0));
  EXPECT_TRUE(std::none_of(safe60.begin(), safe60.end(),
                           [](Seconds s) { return std::abs(s.value() * 60.0 - 1.0) < 1e-9; }));
}

TEST(ExposureGrid, LabelsOfTimesAreTheInverse) {
  for (const double label : {1.0 / 8000, 1.0 / 60, 1.0 / 13, 0.5, 1.0, 1.6, 30.0}) {
    EXPECT_DOUBLE_EQ(LabelOfTime(*TimeOfLabel(Seconds(label)))->value(), label);
  }
  EXPECT_FALSE(LabelOfTime(Seconds(1.0 / 60.0)));
  EXPECT_FALSE(LabelOfTime(Seconds(0.0)));
  EXPECT_FALSE(LabelOfTime(Seconds(1e4)));
}

}  // namespace
}  // namespace lightcal
