// SPDX-License-Identifier: Apache-2.0
// A bracket's merged samples against scenes of known luminance: bias, noise, intervals. The
// simulator (synthetic_camera) shares no code with the estimator and adds pixels of unequal gain, a
// knee of 1 % and noise of whole rows.
#include "lightcal/imaging/bracket/merge_bracket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "merge_truth.h"

namespace lightcal {
namespace {

using test::StepWedge;
using test::SyntheticCamera;
using test::SyntheticExposure;

// The smallest standard deviation any unbiased estimator can have (Cramer and Rao), relative, from
// the true noise of all frames in which the patch lies below `limit` of full scale.
double Bound(const SyntheticCamera& camera, const std::vector<SyntheticExposure>& series,
             double nits, double limit) {
  const double scale = camera.white_dn - camera.black_dn;
  const double electrons = camera.full_well_e;
  const double read =
      (camera.read_noise_e * camera.read_noise_e + camera.row_noise_e * camera.row_noise_e) /
          (electrons * electrons) +
      1.0 / (12.0 * scale * scale);
  double information = 0.0;
  for (const SyntheticExposure& exposure : series) {
    const double level = nits / SaturatingNits(camera, exposure);
    if (level >= limit) continue;
    information += level * level / (level / electrons + read);
  }
  return std::hypot(1.0 / std::sqrt(information), camera.prnu_relative);
}

class StepWedgeMerge : public testing::Test {
 protected:
  static constexpr int kWidth = 1200, kHeight = 800;
  void SetUp() override {
    frames_ = test::ShootBracket(camera_, series_, wedge_.Scene());
    auto merged = test::MergeSamples(frames_, test::RequestOf(series_));
    ASSERT_TRUE(merged.has_value()) << merged.error().message;
    merged_ = std::move(*merged);
    patches_ = test::PatchesOf(wedge_, merged_, 1.0 / SaturatingNits(camera_, series_[0]));
    // One spot reading of a middle patch gives the scale.
    const double anchor = patches_[24].mean / patches_[24].nits;
    for (test::Patch& patch : patches_) patch.mean /= anchor;
  }
  SyntheticCamera camera_ = test::FlawedCamera(kWidth, kHeight);
  StepWedge wedge_{test::LogSteps(0.05, 1e5, 48), 8, kWidth, kHeight};
  std::vector<SyntheticExposure> series_ = test::ExposureSeries(1.0 / 2048, 7, 2.0, 8.0, 0.03, 3);
  std::vector<Frame> frames_;
  test::MergedSamples merged_;
  std::vector<test::Patch> patches_;
};

// Labels rounded to thirds of a stop and shutters off by 3 %: the ratios are measured.
TEST_F(StepWedgeMerge, LuminanceKeepsItsRatiosOverSixDecades) {
  for (const test::Patch& patch : patches_) {
    const double chance = 4.5 * std::sqrt(patch.variance / patch.count) / patch.nits;
    EXPECT_NEAR(patch.mean / patch.nits, 1.0, 0.001 + chance) << patch.nits << " cd/m2";
  }
}

TEST_F(StepWedgeMerge, ExposuresAreFoundToThreeTenThousandths) {
  std::vector<double> off;
  for (std::size_t i = 0; i < series_.size(); ++i) {
    off.push_back(merged_.planned.ln_exposure[i] -
                  std::log(TrueExposure(series_[merged_.planned.order[i]])));
  }
  const auto [low, high] = std::minmax_element(off.begin(), off.end());
  EXPECT_LT(*high - *low, 6e-4);
}

TEST_F(StepWedgeMerge, NoiseIsWithinTwoPercentOfTheBound) {
  const double usable = merged_.planned.plan.usable;
  for (const test::Patch& patch : patches_) {
    const double sd = std::sqrt(patch.variance) / patch.nits;
    // A patch between the two limits has the longer frame in some of its pixels only.
    const double bound = Bound(camera_, series_, patch.nits, usable);
    const double chance = 4.0 / std::sqrt(2.0 * patch.count);
    EXPECT_LT(sd, bound * (1.02 + chance)) << patch.nits << " cd/m2";
    EXPECT_GT(sd, Bound(camera_, series_, patch.nits, 0.97) * (0.98 - chance)) << patch.nits;
  }
}

TEST_F(StepWedgeMerge, TheKneeIsNoticed) {
  EXPECT_LT(merged_.planned.plan.usable, 0.9);
  EXPECT_GT(merged_.planned.plan.usable, 0.8);
}

TEST_F(StepWedgeMerge, TheNoiseOfTheSensorIsFoundFromTheBracketAlone) {
  const double electrons = camera_.full_well_e;
  EXPECT_EQ(merged_.planned.noise_source, NoiseSource::kEstimated);
  EXPECT_NEAR(merged_.planned.plan.noise[0].scale * electrons, 1.0, 0.02);
  const double read = std::sqrt(merged_.planned.plan.noise[0].offset) * electrons;
  EXPECT_NEAR(read, std::sqrt(3.5 * 3.5 + 0.25 + std::pow(60000.0 / 15359, 2) / 12), 0.1);
  EXPECT_NEAR(merged_.planned.plan.fixed_pattern, camera_.prnu_relative, 0.0015);
}

TEST_F(StepWedgeMerge, IntervalsHoldTheTruthAsOftenAsTheySay) {
  double covered = 0.0, count = 0.0;
  for (const test::Patch& patch : patches_) {
    covered += patch.covered * patch.count;
    count += patch.count;
  }
  EXPECT_GE(count, 1e5);
  EXPECT_GT(covered / count, 0.65);
  EXPECT_LT(covered / count, 0.71);
}

TEST(BracketMerger, SignalsBelowBlackStay) {
  SyntheticCamera camera = test::FlawedCamera(64, 64);
  const auto series = test::ExposureSeries(1.0 / 512, 3, 2.0, 8.0, 0.0, 5);
  const StepWedge wedge{{1e-4, 1e4}, 2, 64, 64};
  const auto merged = test::MergeSamples(test::ShootBracket(camera, series, wedge.Scene()),
                                         test::RequestOf(series));
  ASSERT_TRUE(merged.has_value()) << merged.error().message;
  const auto negative =
      std::count_if(merged->value.begin(), merged->value.end(), [](float x) { return x < 0.0F; });
  EXPECT_GT(negative, 64 * 64 / 2 * 4 / 10);
  for (const float v : merged->variance) EXPECT_GT(v, 0.0F);
}

TEST(BracketMerger, APixelClippedInEveryFrameIsALowerBoundWithAllOfItselfAsSigma) {
  SyntheticCamera camera = test::FlawedCamera(64, 64);
  const auto series = test::ExposureSeries(1.0 / 64, 3, 1.0, 8.0, 0.0, 5);
  const double top = SaturatingNits(camera, series[0]);
  const StepWedge wedge{{0.3 * top, 5.0 * top}, 2, 64, 64};
  const auto merged = test::MergeSamples(test::ShootBracket(camera, series, wedge.Scene()),
                                         test::RequestOf(series));
  ASSERT_TRUE(merged.has_value()) << merged.error().message;
  EXPECT_EQ(merged->clipped, 64U * 32U);
  EXPECT_NEAR(merged->value[40], 1.0, 0.001);  // units of the shortest frame's full scale
  EXPECT_NEAR(std::sqrt(merged->variance[40]), merged->value[40], 1e-4);
}

}  // namespace
}  // namespace lightcal
