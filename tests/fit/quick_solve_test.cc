// SPDX-License-Identifier: Apache-2.0
// The quick solver finds what the full one finds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "lightcal/fit/model/small_cholesky.h"
#include "lightcal/fit/model/solve.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

// Six readings in the solver's units, 1.4 % noise, offset and ambient light under their priors.
Estimation SixReadings(std::mt19937_64& random, double ambient) {
  std::normal_distribution<double> noise(0.0, 0.014);
  Estimation estimation;
  const double d0 = 2.0 * noise(random);
  for (int i = 0; i < 6; ++i) {
    ReadingRow row;
    row.distance = 0.35 * std::pow(8.0, i / 5.0);
    const double r = row.distance + d0;
    row.measured = (1.0 / (r * r) + ambient) * std::exp(noise(random));
    row.sigma = 0.014;
    estimation.rows.push_back(row);
  }
  estimation.rules[kLnIntensity].free = true;
  estimation.rules[kDistanceOffset] = {true, 0.0, 0.05};
  estimation.rules[kAmbient] = {true, 0.0, 0.2};
  estimation.least_distance_offset = -0.3;
  return estimation;
}

TEST(SolveQuickly, AgreesWithTheFullSolverToABillionth) {
  std::mt19937_64 random(8);
  int quick = 0;
  for (int i = 0; i < 500; ++i) {
    const Estimation estimation = SixReadings(random, i % 2 == 0 ? 0.05 : 0.0);
    const Theta start = ScanStart(estimation);
    const auto full = SolveInFull(estimation, start);
    const auto fast = SolveQuickly(estimation, start);
    ASSERT_TRUE(full.has_value());
    if (!fast) continue;
    ++quick;
    for (int k = 0; k < kParameters; ++k) EXPECT_NEAR((*fast)[k], (*full)[k], 1e-9) << i;
  }
  EXPECT_GE(quick, 490);
}

TEST(SolveQuickly, AThousandStartsEndAtOneOptimum) {
  std::mt19937_64 random(9);
  const Estimation estimation = SixReadings(random, 0.05);
  const auto best = SolveInFull(estimation, ScanStart(estimation));
  ASSERT_TRUE(best.has_value());
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 1000; ++i) {
    const Theta start = {6.0 * uniform(random) - 3.0, 1.3 * uniform(random) - 0.29,
                         0.3 * uniform(random)};
    const auto found = Solve(estimation, start);
    ASSERT_TRUE(found.has_value());
    for (int k = 0; k < kParameters; ++k) EXPECT_NEAR((*found)[k], (*best)[k], 1e-8) << i;
  }
}

// Matrices made of a known triangle: m = L L^T, b = m x.
TEST(SolvePositive, FindsWhatMadeTheRightSide) {
  constexpr int kMost = 6;
  std::mt19937_64 random(10);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 600; ++i) {
    const int n = 1 + i % kMost;
    std::array<std::array<double, kMost>, kMost> lower{};
    std::array<double, kMost> x{};
    for (int a = 0; a < n; ++a) {
      x[a] = normal(random);
      for (int b = 0; b < a; ++b) lower[a][b] = 0.5 * normal(random);
      lower[a][a] = std::exp(0.3 * normal(random));
    }
    SmallMatrix<kMost> m{};
    std::array<double, kMost> found{};
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        double sum = 0.0;
        for (int k = 0; k < n; ++k) sum += lower[a][k] * lower[b][k];
        if (b <= a) m[a * kMost + b] = sum;
        found[a] += sum * x[b];
      }
    }
    ASSERT_TRUE(SolvePositive<kMost>(m, n, found)) << i;
    for (int a = 0; a < n; ++a) EXPECT_NEAR(found[a], x[a], 1e-9) << i;
  }
}

TEST(SolvePositive, TellsWhatIsNotPositive) {
  SmallMatrix<3> saddle = {1.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0};  // det of 2 x 2 is -3
  std::array<double, 3> x = {1.0, 1.0, 1.0};
  EXPECT_FALSE(SolvePositive<3>(saddle, 3, x));
  SmallMatrix<3> empty{};
  EXPECT_FALSE(SolvePositive<3>(empty, 1, x));
}

}  // namespace
}  // namespace lightcal::fit
