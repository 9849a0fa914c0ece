// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/standard_normal.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace lightcal {
namespace {

constexpr int kDraws = 200000;

// Closed form: P(z < t) = erfc(-t / sqrt 2) / 2. Three standard deviations of a share of so many.
TEST(StandardNormal, FallsBelowAsOftenAsTheNormalLawSays) {
  std::mt19937_64 random(20261127);
  StandardNormal normal;
  std::vector<double> draws(kDraws);
  for (double& z : draws) z = normal(random);
  for (const double limit : std::array{-3.0, -1.96, -1.0, -0.2, 0.0, 0.5, 1.0, 1.645, 2.576}) {
    int below = 0;
    for (const double z : draws) below += z < limit ? 1 : 0;
    const double share = 0.5 * std::erfc(-limit / std::sqrt(2.0));
    EXPECT_NEAR(static_cast<double>(below) / kDraws, share,
                3.0 * std::sqrt(share * (1.0 - share) / kDraws))
        << limit;
  }
}

// Both draws of one point of the disk, and neighbouring points.
TEST(StandardNormal, OfNeighboursTellNothingOfEachOther) {
  std::mt19937_64 random(7);
  StandardNormal normal;
  double last = normal(random), products = 0.0, of_squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double z = normal(random);
    products += z * last;
    of_squares += (z * z - 1.0) * (last * last - 1.0);
    last = z;
  }
  EXPECT_NEAR(products / kDraws, 0.0, 3.0 / std::sqrt(kDraws));
  EXPECT_NEAR(of_squares / kDraws, 0.0, 3.0 * 2.0 / std::sqrt(kDraws));
}

// Another implementation of the same method: that of GCC's library, digit for digit.
#if defined(__GLIBCXX__)
TEST(StandardNormal, AgreesDigitForDigitWithTheLibraryOfGcc) {
  std::mt19937_64 random(11), theirs(11);
  StandardNormal normal;
  std::normal_distribution<double> library;
  for (int i = 0; i < 10000; ++i) ASSERT_EQ(normal(random), library(theirs)) << i;
}
#endif

}  // namespace
}  // namespace lightcal
