// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {
namespace {

const Theta kTruth = {std::log(7.0), 0.05, 0.3, std::log(0.1), -0.8, 0.3};

ReadingRow RowAtTruth(ReadingRow::Form form, AxialShape shape = {}) {
  ReadingRow row;
  row.form = form;
  row.shape = shape;
  row.distance = 1.3;
  row.direct_gain = 0.8;
  row.bounce = 0.02;
  row.sigma = 0.1;
  row.measured = RowIlluminance(row, kTruth.data());
  return row;
}

class EachCost : public testing::TestWithParam<ReadingRow::Form> {};

TEST_P(EachCost, IsZeroAtTheTruth) {
  EXPECT_NEAR(RowResidual(RowAtTruth(GetParam()), kTruth), 0.0, 1e-13);
}

TEST_P(EachCost, GrowsWhenTheModelIsTooDark) {
  const ReadingRow row = RowAtTruth(GetParam());
  double last = 0.0;
  for (const double step : {0.05, 0.1, 0.2, 0.4}) {
    const double residual = std::abs(RowResidual(row, {kTruth[0] - step, kTruth[1], kTruth[2]}));
    EXPECT_GT(residual, last);
    last = residual;
  }
}

TEST_P(EachCost, GrowsWhenTheModelIsTooBrightUnlessTheMeterWasOverRange) {
  const ReadingRow row = RowAtTruth(GetParam());
  double last = 0.0;
  for (const double step : {0.05, 0.1, 0.2, 0.4}) {
    const double residual = std::abs(RowResidual(row, {kTruth[0] + step, kTruth[1], kTruth[2]}));
    if (GetParam() == ReadingRow::Form::kCensored) {
      EXPECT_EQ(residual, 0.0);
    } else {
      EXPECT_GT(residual, last);
    }
    last = residual;
  }
}

// A lamp that falls off evenly as it is turned away.
std::shared_ptr<const std::function<double(double, double)>> AsAimed() {
  return std::make_shared<const std::function<double(double, double)>>(
      [](double x, double y) { return 1.0 + 0.3 * x - 0.2 * y; });
}

TEST_P(EachCost, HasTheDerivativeThatFiniteDifferencesShow) {
  for (const AxialShape& shape : {AxialShape{}, AxialShape{AxialShape::Outline::kDisk, 0.4, 0.0},
                                  AxialShape{AxialShape::Outline::kRect, 0.3, 0.5},
                                  AxialShape{AxialShape::Outline::kTube, 0.6, 0.0}}) {
    ReadingRow row = RowAtTruth(GetParam(), shape);
    row.walls = {.x = -0.6, .constant = -0.1, .scatter = 0.1};
    row.scale = 0.8;
    row.by_aim = AsAimed();
    row.measured = 1.2 * RowIlluminance(row, kTruth.data());  // away from the censored cost's kink
    const RowDerivative at = DifferentiateRow(row, kTruth);
    for (int k = 0; k < kParameters; ++k) {
      constexpr double kStep = 1e-6;
      Theta above = kTruth;
      Theta below = kTruth;
      above[k] += kStep;
      below[k] -= kStep;
      const double slope = (RowResidual(row, above) - RowResidual(row, below)) / (2.0 * kStep);
      EXPECT_NEAR(at.gradient[k], slope, 1e-6 * (1.0 + std::abs(slope)));
      EXPECT_NE(at.gradient[k], 0.0);
    }
  }
}

TEST_P(EachCost, HasTheSecondDerivativesOfItsFirst) {
  ReadingRow row = RowAtTruth(GetParam(), {AxialShape::Outline::kRect, 0.3, 0.5});
  row.walls = {.x = -0.6, .constant = -0.1, .scatter = 0.1};
  row.scale = 0.8;
  row.by_aim = AsAimed();
  row.measured = 1.2 * RowIlluminance(row, kTruth.data());
  double residual = 0.0;
  std::array<double, kParameters> gradient{};
  std::array<double, kParameters * kParameters> bend{};
  ASSERT_TRUE(
      RowResidual<kParameters>(row, kTruth.data(), &residual, gradient.data(), bend.data()));
  for (int k = 0; k < kParameters; ++k) {
    constexpr double kStep = 1e-5;
    Theta above = kTruth, below = kTruth;
    above[k] += kStep;
    below[k] -= kStep;
    const RowDerivative more = DifferentiateRow(row, above), less = DifferentiateRow(row, below);
    for (int j = k; j < kParameters; ++j) {
      const double slope = (more.gradient[j] - less.gradient[j]) / (2.0 * kStep);
      const double scale = std::max(1.0, std::abs(slope));
      EXPECT_NEAR(bend[j + k * kParameters], slope, 2e-5 * scale) << j << " by " << k;
    }
  }
}

TEST_P(EachCost, IsMeasuredInStandardDeviations) {
  ReadingRow row = RowAtTruth(GetParam());
  row.measured = GetParam() == ReadingRow::Form::kLinear ? row.measured + 2.0 * row.sigma
                                                         : row.measured * std::exp(2.0 * row.sigma);
  EXPECT_NEAR(RowResidual(row, kTruth), 2.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Forms, EachCost,
                         testing::Values(ReadingRow::Form::kLog, ReadingRow::Form::kLinear,
                                         ReadingRow::Form::kCensored));

TEST(LinearIlluminanceCost, KeepsTheSignOfANegativeReading) {
  ReadingRow row = RowAtTruth(ReadingRow::Form::kLinear);
  row.measured = -0.5;
  EXPECT_NEAR(RowResidual(row, kTruth), (-0.5 - RowIlluminance(row, kTruth.data())) / 0.1, 1e-12);
}

TEST(LogIlluminanceCost, IsUndefinedWhereTheModelIsDark) {
  ReadingRow row = RowAtTruth(ReadingRow::Form::kLog);
  EXPECT_FALSE(
      std::isfinite(RowResidual(row, {kTruth[0], kTruth[1], -100.0, kTruth[3], kTruth[4]})));
}

TEST(Prior, CountsStandardDeviationsFromItsMean) {
  Estimation estimation;
  estimation.rules[kDistanceOffset] = {true, 0.2, 0.05};
  EXPECT_EQ(HalfChiSquared(estimation, {0.0, 0.2, 0.0}), 0.0);
  EXPECT_NEAR(HalfChiSquared(estimation, {0.0, 0.1, 0.0}), 0.5 * 4.0, 1e-12);
}

}  // namespace
}  // namespace lightcal::fit
