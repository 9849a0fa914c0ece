// SPDX-License-Identifier: Apache-2.0
// The quantiles of a mixture of normal distributions: known in closed form where it has one part,
// and by their definition where it has more.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/core/normal_mixture.h"

namespace lightcal {
namespace {

double Below(const std::vector<NormalPart>& mixture, double x) {
  double below = 0.0;
  double whole = 0.0;
  for (const NormalPart& part : mixture) {
    below += 0.5 * part.weight * std::erfc((part.mean - x) / (part.sd * std::numbers::sqrt2));
    whole += part.weight;
  }
  return below / whole;
}

TEST(Mixture, OfOneNormalHasItsQuantiles) {
  const std::vector<NormalPart> one = {{0.3, 4.0, 0.5}};
  EXPECT_NEAR(QuantileOf(one, 0.5), 4.0, 1e-14);
  EXPECT_NEAR(QuantileOf(one, 0.975), 4.0 + 0.5 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(QuantileOf(one, 0.025), 4.0 - 0.5 * 1.959963984540054, 1e-12);
}

TEST(Mixture, HasAsMuchBelowAQuantileAsAsked) {
  const std::vector<std::vector<NormalPart>> mixtures = {
      {{0.5, 0.0, 1.0}, {0.5, 0.1, 1.2}},
      {{0.9, 0.0, 1e-3}, {0.1, 5.0, 0.5}},    // a needle beside a hill
      {{0.5, -40.0, 0.1}, {0.5, 40.0, 0.1}},  // next to nothing between two
      {{0.02, 3.0, 2.0}, {0.95, 0.0, 0.2}, {0.03, 8.0, 0.01}}};
  for (const auto& mixture : mixtures) {
    for (const double probability : {1e-4, 0.025, 0.3, 0.6, 0.975, 0.9999}) {
      EXPECT_NEAR(Below(mixture, QuantileOf(mixture, probability)), probability, 1e-11);
    }
  }
}

TEST(Mixture, OfPartsWithoutWidthEndsAtOneOfThem) {
  const std::vector<NormalPart> points = {{0.3, 1.0, 0.0}, {0.7, 2.0, 0.0}};
  EXPECT_NEAR(QuantileOf(points, 0.2), 1.0, 1e-9);
  EXPECT_NEAR(QuantileOf(points, 0.9), 2.0, 1e-9);
}

}  // namespace
}  // namespace lightcal
