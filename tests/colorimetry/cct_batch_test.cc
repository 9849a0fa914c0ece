// SPDX-License-Identifier: Apache-2.0
// Truth of the batch: the function of one colour.
#include "lightcal/colorimetry/cct_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lightcal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void ExpectSame(const CctResult& batch, const CctResult& one) {
  ASSERT_EQ(batch.status, one.status);
  if (one.status == CctStatus::kNotAChromaticity) return;
  if (std::isinf(one.temperature.value())) {
    EXPECT_TRUE(std::isinf(batch.temperature.value()));
  } else {
    EXPECT_LE(std::abs(batch.temperature / one.temperature - 1.0), 1e-10)
        << one.temperature.value() << " K, duv " << one.duv;
  }
  EXPECT_NEAR(batch.duv, one.duv, 1e-12);
}

TEST(CctBatch, EqualsOneColourAtATimeWhereTemperaturesAreValid) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> mireds(1.0, 1000.0), duv(-0.05, 0.05);
  std::vector<Uv1960> colors;
  for (int i = 0; i < 20'000; ++i) {
    colors.push_back(UvFromCct(KelvinFromMireds(Mireds(mireds(random))), duv(random)));
  }
  std::vector<CctResult> results(colors.size());
  CctBatch(colors, results);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    ASSERT_TRUE(results[i].valid());
    ASSERT_NO_FATAL_FAILURE(ExpectSame(results[i], CctFromUv(colors[i])));
  }
}

TEST(CctBatch, EqualsOneColourAtATimeAllOverThePlane) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> x(-0.1, 1.0), y(-0.1, 1.0);
  std::vector<Xy> colors;
  for (int i = 0; i < 20'000; ++i) colors.push_back({x(random), y(random)});
  std::vector<CctResult> results(colors.size());
  CctBatch(colors, results);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    ASSERT_NO_FATAL_FAILURE(ExpectSame(results[i], CctFromXy(colors[i])));
  }
}

TEST(CctBatch, AnswersNumbersThatAreNoColours) {
  const std::vector<Xy> colors = {{kNaN, 0.3}, {0.3, kNaN}, {kInfinity, 0.3}, {0.3, -kInfinity},
                                  {0.3, 0.0},  {4.0, 0.2},  {1e300, 1e300},   {0.3127, 0.3290}};
  std::vector<CctResult> results(colors.size());
  CctBatch(colors, results);
  for (std::size_t i = 0; i + 1 < colors.size(); ++i) {
    EXPECT_EQ(results[i].status, CctFromXy(colors[i]).status) << i;
  }
  EXPECT_TRUE(results.back().valid());
}

TEST(CctBatch, FillsExactlyAsManyResultsAsThereAreColours) {
  for (const std::size_t count : {0u, 1u, 127u, 128u, 129u, 300u}) {
    const std::vector<Xy> colors(count, Xy{0.35, 0.35});
    std::vector<CctResult> results(count + 1);
    CctBatch(colors, results);
    for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(results[i].valid());
    EXPECT_EQ(results[count].status, CctStatus::kNotAChromaticity);
  }
}

}  // namespace
}  // namespace lightcal
