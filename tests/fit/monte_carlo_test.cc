// SPDX-License-Identifier: Apache-2.0
// Sampling agrees with the covariance where that is right, and with the truth where it is not.
#include "lightcal/fit/model/monte_carlo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "lamp_twin.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

Estimation Readings(const std::vector<double>& distances, double sigma, double ambient) {
  Estimation estimation;
  for (const double d : distances) {
    ReadingRow row;
    row.distance = d;
    row.measured = 1.0 / (d * d) + ambient;
    row.sigma = sigma;
    estimation.rows.push_back(row);
  }
  estimation.rules[kLnIntensity].free = true;
  estimation.rules[kDistanceOffset] = {true, 0.0, 0.15 * distances.front()};
  estimation.least_distance_offset = -0.9 * distances.front();
  return estimation;
}

UncertaintyInput InputOf(const Estimation& estimation) {
  UncertaintyInput input;
  input.estimation = &estimation;
  input.theta = *Solve(estimation, ScanStart(estimation));
  return input;
}

TEST(MonteCarlo, AgreesWithTheCovarianceWhereTheModelIsNearlyLinear) {
  const Estimation estimation = Readings({0.35, 0.7, 1.4, 2.8}, 0.005, 0.0);
  UncertaintyInput input = InputOf(estimation);
  input.considered = {{0.004, 0.0}, {0.002, 1.0}};
  const auto linear = EstimateCovariance(input);
  const auto sampled = SampleEstimate(input, {.digits = 1, .largest_blocks = 30});
  ASSERT_TRUE(linear && sampled);
  EXPECT_TRUE(sampled->stable);
  EXPECT_EQ(sampled->samples % SamplingRule{}.block, 0);
  for (const Parameter k : {kLnIntensity, kDistanceOffset}) {
    const double sd = std::sqrt((*linear)[k * kParameters + k]);
    const SampledParameter& p = sampled->parameters[k];
    EXPECT_NEAR(p.sd, sd, 0.02 * sd);
    EXPECT_NEAR(p.mean, input.theta[k], 0.05 * sd);
    EXPECT_NEAR(p.low, input.theta[k] - kZ95 * sd, 0.1 * sd);
    EXPECT_NEAR(p.high, input.theta[k] + kZ95 * sd, 0.1 * sd);
  }
}

TEST(MonteCarlo, ACalibrationIsOneFactorForAllRows) {
  Estimation estimation = Readings({0.35, 0.7, 1.4, 2.8}, 0.005, 0.0);
  for (ReadingRow& row : estimation.rows) row.calibration = 0.03;
  const UncertaintyInput input = InputOf(estimation);
  const auto sampled = SampleEstimate(input);
  const auto linear = EstimateCovariance(input);
  ASSERT_TRUE(linear && sampled);
  EXPECT_GT(sampled->parameters[kLnIntensity].sd, 0.03);
  EXPECT_NEAR(sampled->parameters[kLnIntensity].sd, std::sqrt((*linear)[0]), 0.0006);
}

// One reading at d = 1, d0 ~ N(0, 0.15^2): ln I = ln m + s z + 2 ln(1 + 0.15 z'), here by its own
// loop of a million draws.
TEST(MonteCarlo, OneReadingsIntervalIsSkewedAsItsOffsetIs) {
  Estimation estimation = Readings({1.0}, 0.05, 0.0);
  estimation.rules[kDistanceOffset].free = false;
  const auto sampled = SampleEstimate(InputOf(estimation));
  ASSERT_TRUE(sampled.has_value());
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> truth(1000000);
  for (double& ln : truth) ln = 0.05 * normal(random) + 2.0 * std::log1p(0.15 * normal(random));
  std::sort(truth.begin(), truth.end());
  const SampledParameter& ln = sampled->parameters[kLnIntensity];
  EXPECT_NEAR(ln.low, truth[25000], 0.01);
  EXPECT_NEAR(ln.high, truth[975000], 0.01);
  EXPECT_GT(-ln.low, 1.1 * ln.high) << "longer below";
}

// Sixty readings at three places hold what their three weighted means do, and cost no more.
TEST(MonteCarlo, ReadingsOfOnePlaceAreDrawnAsTheirMean) {
  Estimation means = Readings({0.5, 1.0, 2.0}, 0.02, 0.0);
  Estimation many = means;
  many.rows.clear();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (ReadingRow& mean : means.rows) {
    double weights = 0.0;
    double ln = 0.0;
    for (int i = 0; i < 20; ++i) {
      ReadingRow row = mean;
      row.sigma = i < 10 ? 0.02 : 0.05;
      row.measured *= std::exp(row.sigma * normal(random));
      weights += 1.0 / (row.sigma * row.sigma);
      ln += std::log(row.measured) / (row.sigma * row.sigma);
      many.rows.push_back(row);
    }
    mean.measured = std::exp(ln / weights);
    mean.sigma = 1.0 / std::sqrt(weights);
  }
  const auto a = SampleEstimate(InputOf(many), JustSamples(40000));
  const auto b = SampleEstimate(InputOf(means), JustSamples(40000));
  ASSERT_TRUE(a && b);
  for (const Parameter k : {kLnIntensity, kDistanceOffset}) {
    const SampledParameter &x = a->parameters[k], &y = b->parameters[k];
    // The same problem up to rounding, and all but the same draws.
    EXPECT_NEAR(x.mean, y.mean, 0.02 * y.sd);
    EXPECT_NEAR(x.sd, y.sd, 0.02 * y.sd);
    EXPECT_NEAR(x.low, y.low, 0.06 * y.sd);
    EXPECT_NEAR(x.high, y.high, 0.06 * y.sd);
  }
}

TEST(MonteCarlo, TheSameReadingsGiveTheSameSamples) {
  const Estimation estimation = Readings({0.5, 1.0, 2.0}, 0.02, 0.0);
  const auto a = SampleEstimate(InputOf(estimation));
  const auto b = SampleEstimate(InputOf(estimation));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->samples, b->samples);
  for (int k = 0; k < kParameters; ++k) EXPECT_EQ(a->parameters[k].low, b->parameters[k].low);
}

TEST(MonteCarlo, AmbientLightStaysAboveNothing) {
  Estimation estimation = Readings({0.35, 0.7, 1.4, 2.8}, 0.02, 0.0);
  estimation.rules[kAmbient] = {true, 0.0, 0.1};
  const auto sampled = SampleEstimate(InputOf(estimation), {.digits = 1, .largest_blocks = 10});
  ASSERT_TRUE(sampled.has_value());
  EXPECT_GE(sampled->parameters[kAmbient].low, 0.0);
  EXPECT_GT(sampled->parameters[kAmbient].high, 0.0);
}

TEST(MonteCarlo, AsManyDrawsAsAskedForTellAnIntervalToTheirRoot) {
  const Estimation estimation = Readings({0.35, 0.7, 1.4, 2.8}, 0.005, 0.0);
  const UncertaintyInput input = InputOf(estimation);
  const auto linear = EstimateCovariance(input);
  ASSERT_TRUE(linear);
  const double half = kZ95 * std::sqrt((*linear)[0]);
  for (const int samples : {2, 1000, 10000, 25000, 100000}) {
    const auto sampled = SampleEstimate(input, JustSamples(samples));
    ASSERT_TRUE(sampled) << samples;
    EXPECT_GE(sampled->samples, samples);
    EXPECT_LE(sampled->samples, samples + 10);
    if (samples == 2) continue;
    // A quantile at 2.5 % of N normal draws scatters by 2.67 sd/sqrt(N); half the distance between
    // two of them by 0.96 of half the interval / sqrt(N). Four of these, and how far the model is
    // from linear.
    const SampledParameter& ln = sampled->parameters[kLnIntensity];
    EXPECT_NEAR(0.5 * (ln.high - ln.low) / half, 1.0, 4.0 * 0.96 / std::sqrt(samples) + 0.003)
        << samples;
  }
}

TEST(MonteCarlo, OnRequestItsIntervalReplacesTheLinearOne) {
  test::TwinSession twin(test::LampTruth{}, 0.02, 4);
  twin.On({0.5, 1.0, 2.0});
  const auto linear = FitSession(twin.session(), {});
  const auto sampled = FitSession(twin.session(), FitSettings{.monte_carlo = true});
  ASSERT_TRUE(linear && sampled);
  const Uncertain& a = *linear->lights.lights.front().intensity_cd;
  const Uncertain& b = *sampled->lights.lights.front().intensity_cd;
  EXPECT_EQ(a.value, b.value);
  EXPECT_NE(*a.low, *b.low);
  EXPECT_NEAR(b.u95, a.u95, 0.1 * a.u95);
  ASSERT_EQ(sampled->notes.size(), 1U);
  EXPECT_NE(sampled->notes.front().find("samples"), std::string::npos);
}

}  // namespace
}  // namespace lightcal::fit
