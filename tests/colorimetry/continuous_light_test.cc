// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/continuous_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/light_models.h"

namespace lightcal {
namespace {

Spectrum EveryNth(const Spectrum& fine, std::size_t step) {
  Spectrum s;
  for (std::size_t i = 0; i < fine.values.size(); i += step) {
    s.wavelengths_nm.push_back(fine.wavelengths_nm[i]);
    s.values.push_back(fine.values[i]);
  }
  return s;
}

TEST(ContinuousLight, IsThermalRadiationAndDaylightInAnyStep) {
  for (const std::size_t step : {1u, 5u, 10u, 20u}) {
    for (const double k : {1200.0, 2856.0, 5000.0, 15'000.0}) {
      EXPECT_TRUE(IsContinuousLight(EveryNth(*BlackBodySpectrum(Kelvin(k)), step))) << k;
    }
    for (const double k : {4000.0, 6504.0, 20'000.0}) {
      EXPECT_TRUE(IsContinuousLight(EveryNth(*DaylightSpectrum(Kelvin(k)), step))) << k;
    }
  }
}

TEST(ContinuousLight, IsAWhiteLedWhosePumpTheStepResolves) {
  for (const double k : {3000.0, 4000.0, 6500.0}) {
    const Spectrum led = PhosphorLedSpectrum(Kelvin(k), Nanometres(590)).value();
    EXPECT_TRUE(IsContinuousLight(EveryNth(led, 5))) << k;
    EXPECT_FALSE(IsContinuousLight(EveryNth(led, 10))) << k;
  }
}

// Two bells as a halophosphate lamp's continuum has, its mercury lines unseen.
TEST(ContinuousLight, IsNotAPhosphorWithoutItsPump) {
  Spectrum lamp;
  for (int nm = 380; nm <= 780; nm += 5) {
    lamp.wavelengths_nm.push_back(nm);
    lamp.values.push_back(0.5 * std::exp(-0.5 * std::pow((nm - 480) / 40.0, 2)) +
                          std::exp(-0.5 * std::pow((nm - 585) / 35.0, 2)));
  }
  EXPECT_FALSE(IsContinuousLight(lamp));
  lamp.values[13] += 3.0;  // one line on one sample at 445 nm is no pump
  EXPECT_FALSE(IsContinuousLight(lamp));
}

TEST(ContinuousLight, IsNothingThatCannotBeJudged) {
  EXPECT_FALSE(IsContinuousLight({}));
  EXPECT_FALSE(IsContinuousLight({{400.0, 500.0, 600.0}, {0.0, 0.0, 0.0}}));
  EXPECT_FALSE(IsContinuousLight({{400.0, 500.0, 600.0}, {-1.0, -1.0, -1.0}}));
}

}  // namespace
}  // namespace lightcal
