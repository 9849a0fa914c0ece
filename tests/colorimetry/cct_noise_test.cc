// SPDX-License-Identifier: Apache-2.0
// Truth: brute-force Monte Carlo over X, Y and Z.
#include "lightcal/colorimetry/cct_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lightcal {
namespace {

// Running mean and spread.
struct Spread {
  double n = 0.0, mean = 0.0, squares = 0.0;
  void Add(double value) {
    n += 1.0;
    const double before = value - mean;
    mean += before / n;
    squares += before * (value - mean);
  }
  [[nodiscard]] double StandardDeviation() const { return std::sqrt(squares / (n - 1.0)); }
};

TEST(CctNoise, MatchesMonteCarloWithinFivePercentAtOnePercentNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const double kelvin : {2000.0, 2856.0, 4000.0, 6504.0, 10'000.0, 20'000.0}) {
    for (const double duv : {-0.02, 0.0, 0.02}) {
      const Xyz color = XyzFromXyAtUnitY(XyFromCct(Kelvin(kelvin), duv));
      const auto reported = NoiseOfCct(color, RelativeNoise(color, 0.01));
      ASSERT_TRUE(reported);
      Spread t, d;
      for (int i = 0; i < 20'000; ++i) {
        const Xyz noisy = {color.X * (1.0 + 0.01 * normal(random)),
                           color.Y * (1.0 + 0.01 * normal(random)),
                           color.Z * (1.0 + 0.01 * normal(random))};
        const CctResult cct = CctFromXy(XyFromXyz(noisy));
        t.Add(cct.temperature.value());
        d.Add(cct.duv);
      }
      EXPECT_NEAR(reported->temperature.value() / t.StandardDeviation(), 1.0, 0.05)
          << kelvin << " K, duv " << duv;
      EXPECT_NEAR(reported->duv / d.StandardDeviation(), 1.0, 0.05) << kelvin << " K, duv " << duv;
      EXPECT_NEAR(reported->snr, 100.0, 1e-9);
    }
  }
}

TEST(CctNoise, OnePercentCostsWhatTheReferenceMeasured) {  // colorimetry reference, section 4
  const auto mireds = [](double kelvin) {
    const Xyz c = XyzFromXyAtUnitY(XyFromCct(Kelvin(kelvin)));
    return NoiseOfCct(c, RelativeNoise(c, 0.01))->mireds.value();
  };
  EXPECT_NEAR(mireds(2856.0), 8.7, 0.1);
  EXPECT_NEAR(mireds(4000.0), 6.0, 0.1);
  EXPECT_NEAR(mireds(6504.0), 3.4, 0.1);
  EXPECT_NEAR(mireds(20'000.0), 3.2, 0.1);
}

TEST(CctNoise, IsTooMuchBelowAnSnrOfThirty) {
  const Xyz color = XyzFromXyAtUnitY(XyFromCct(Kelvin(5000.0)));
  EXPECT_FALSE(NoiseOfCct(color, RelativeNoise(color, 0.0333))->too_noisy());
  EXPECT_TRUE(NoiseOfCct(color, RelativeNoise(color, 0.0334))->too_noisy());
}

TEST(CctNoise, IsAbsentWithoutNoiseOrWithoutATemperature) {
  const Xyz white = XyzFromXyAtUnitY({0.3127, 0.3290});
  EXPECT_FALSE(NoiseOfCct(white, {}));
  const Xyz blue = XyzFromXyAtUnitY({0.15, 0.06});
  EXPECT_FALSE(NoiseOfCct(blue, RelativeNoise(blue, 0.01)));
}

}  // namespace
}  // namespace lightcal
