// SPDX-License-Identifier: Apache-2.0
// The search over combinations against every combination there is.
#include "lightcal/tradeoff/combine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace lightcal::tradeoff {
namespace {

constexpr std::size_t kFigures = 3;

CombineInput RandomInput(std::mt19937_64& random, std::size_t knobs, std::size_t levels) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  CombineInput input;
  input.usual.assign(knobs, 0);
  input.seconds = 1.0;
  for (std::size_t i = 0; i < kFigures; ++i) {
    input.differences.push_back(0.002 * (share(random) - 0.5));
    input.limits.push_back(0.01);
  }
  input.changes.resize(knobs);
  for (auto& of_knob : input.changes) {
    for (std::size_t level = 1; level < levels; ++level) {
      Change change{level, -share(random) / static_cast<double>(knobs), {}};
      const double size = std::pow(10.0, -4.0 + 2.5 * share(random));
      for (std::size_t i = 0; i < kFigures; ++i) {
        change.differences.push_back(size * (2.0 * share(random) - 1.0));
      }
      of_knob.push_back(std::move(change));
    }
  }
  return input;
}

struct Truth {
  double seconds = std::numeric_limits<double>::infinity();
  double worst = std::numeric_limits<double>::infinity();
};

// Every combination, by counting in base `levels`.
template <class Visit>
void EveryCombination(const CombineInput& input, const Visit& visit) {
  std::vector<std::size_t> at(input.changes.size(), 0);  // 0 = usual, i = i-th change
  for (;;) {
    double seconds = input.seconds;
    std::vector<double> differences = input.differences;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (at[k] == 0) continue;
      const Change& change = input.changes[k][at[k] - 1];
      seconds += change.seconds;
      for (std::size_t i = 0; i < kFigures; ++i) differences[i] += change.differences[i];
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < kFigures; ++i) {
      worst = std::max(worst, std::abs(differences[i]) / input.limits[i]);
    }
    visit(seconds, worst);
    std::size_t k = 0;
    while (k < at.size() && ++at[k] > input.changes[k].size()) at[k++] = 0;
    if (k == at.size()) return;
  }
}

TEST(BestCombinations, FindsTheCheapestOfEvery) {
  std::mt19937_64 random(20261122);
  for (int trial = 0; trial < 60; ++trial) {
    const CombineInput input = RandomInput(random, 5, 4);
    Truth truth;
    EveryCombination(input, [&](double seconds, double worst) {
      if (worst <= 1.0) truth.seconds = std::min(truth.seconds, seconds);
    });
    const auto found = BestCombinations(input, 6);
    ASSERT_EQ(found.size(), 6U);
    EXPECT_LE(found.front().worst, 1.0);
    EXPECT_NEAR(found.front().seconds, truth.seconds, 1e-12) << trial;
    EXPECT_TRUE(std::ranges::is_sorted(found, {}, &Foretold::seconds));
  }
}

TEST(BestCombinations, UnderABudgetFindsTheMostAccurate) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    CombineInput input = RandomInput(random, 5, 4);
    input.budget = 0.5;
    Truth truth;
    EveryCombination(input, [&](double seconds, double worst) {
      if (seconds <= input.budget) truth.worst = std::min(truth.worst, worst);
    });
    const auto found = BestCombinations(input, 3);
    ASSERT_FALSE(found.empty());
    if (!std::isfinite(truth.worst)) continue;
    EXPECT_LE(found.front().seconds, input.budget);
    EXPECT_NEAR(found.front().worst, truth.worst, 1e-12) << trial;
  }
}

// Thirteen knobs do not fit the beam; what it finds is allowed and no dearer than each knob alone.
TEST(BestCombinations, ManyKnobsStayAllowed) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 10; ++trial) {
    const CombineInput input = RandomInput(random, 13, 4);
    const auto found = BestCombinations(input, 6);
    ASSERT_FALSE(found.empty());
    EXPECT_LE(found.front().worst, 1.0);
    for (const auto& of_knob : input.changes) {
      for (const Change& change : of_knob) {
        double worst = 0.0;
        for (std::size_t i = 0; i < kFigures; ++i) {
          worst = std::max(
              worst, std::abs(input.differences[i] + change.differences[i]) / input.limits[i]);
        }
        if (worst > 1.0) continue;
        EXPECT_LE(found.front().seconds, input.seconds + change.seconds + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace lightcal::tradeoff
