// SPDX-License-Identifier: Apache-2.0
// Every merge estimator's sigma is what brackets scatter: frames are drawn electron by electron
// here, by the law alone, with nothing of the merge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/imaging/bracket/merge_bracket.h"

namespace lightcal {
namespace {

constexpr double kFullWell = 20000.0;  // electrons
constexpr double kRead = 6.0;
constexpr double kWhite = 15000.0;  // codes
const std::vector<double> kTimes = {1.0, 4.0, 16.0, 64.0};
constexpr int kSamplesAcross = 192, kSamplesDown = 192;  // samples of one signal

// One exposure of an even surface that gives `electrons` in it, a draw a sample.
Frame Exposed(double electrons, std::mt19937_64& random) {
  std::poisson_distribution<long> light(electrons);
  std::normal_distribution<double> read(0.0, kRead);
  auto codes = std::make_shared<std::vector<std::uint16_t>>();
  constexpr double kBlack = 500.0;
  for (int i = 0; i < kSamplesAcross * kSamplesDown; ++i) {
    const double caught = std::min(static_cast<double>(light(random)) + read(random), kFullWell);
    codes->push_back(static_cast<std::uint16_t>(std::lround(kBlack + caught / kFullWell * kWhite)));
  }
  Frame frame;
  frame.info.width = kSamplesAcross;
  frame.info.height = kSamplesDown;
  frame.info.meaning = SampleMeaning::kSensor;
  SensorLevels levels;
  levels.black = {1, 1, {static_cast<float>(kBlack)}};
  levels.white.fill(static_cast<float>(kBlack + kWhite));
  frame.info.levels = levels;
  frame.samples = View2d<const std::uint16_t>(codes->data(), kSamplesAcross, kSamplesDown);
  frame.owner = codes;
  return frame;
}

struct Scatter {
  // In electrons of the shortest frame.
  double mean = 0.0, variance = 0.0;         // of what was found
  double claimed = 0.0, claimed_mean = 0.0;  // variance: of the middle sample, and their mean
};

Scatter ScatterOf(MergeEstimator estimator, double electrons) {
  std::mt19937_64 random(static_cast<std::uint64_t>(1000.0 * electrons));
  std::vector<Frame> frames;
  std::vector<SignalFrame> signals;
  for (const double time : kTimes) {
    frames.push_back(Exposed(electrons * time, random));
    signals.push_back(*SignalOf(frames.back()));
  }
  constexpr double kRounding = kFullWell / kWhite;
  const double read = (kRead * kRead + kRounding * kRounding / 12.0) / (kFullWell * kFullWell);
  MergePlan plan;
  plan.exposure = kTimes;
  plan.noise.assign(kTimes.size(), {1.0 / kFullWell, read});
  plan.fixed_pattern = 0.0;
  plan.estimator = estimator;
  const auto merger = BracketMerger::Make(signals, plan);
  std::vector<float> value(static_cast<std::size_t>(kSamplesAcross) * kSamplesDown),
      variance(value.size());
  static_cast<void>(
      merger->MergeRows(0, kSamplesDown, View2d<float>(value.data(), kSamplesAcross, kSamplesDown),
                        View2d<float>(variance.data(), kSamplesAcross, kSamplesDown)));
  const auto n = static_cast<double>(value.size());
  Scatter out;
  for (std::size_t i = 0; i < value.size(); ++i) {
    out.mean += kFullWell * double{value[i]} / n;
    out.claimed_mean += kFullWell * kFullWell * double{variance[i]} / n;
  }
  const auto middle = variance.begin() + kSamplesAcross * kSamplesDown / 2;
  std::nth_element(variance.begin(), middle, variance.end());
  out.claimed = kFullWell * kFullWell * double{*middle};
  for (const float x : value) {
    const double off = kFullWell * double{x} - out.mean;
    out.variance += off * off / n;
  }
  return out;
}

// By hand: frames whose electrons stay below nine tenths of the well, weighed as documented.
double ExpectedVariance(MergeEstimator estimator, double electrons) {
  double weights = 0.0, spread = 0.0, information = 0.0, last = 0.0;
  for (const double time : kTimes) {
    if (electrons * time >= 0.9 * kFullWell) break;
    const double noise = electrons * time + kRead * kRead;
    weights += time;
    spread += noise;
    information += time * time / noise;
    last = noise / (time * time);
  }
  if (estimator == MergeEstimator::kSums) return spread / (weights * weights);
  return estimator == MergeEstimator::kLongest ? last : 1.0 / information;
}

class Estimator : public ::testing::TestWithParam<MergeEstimator> {};

TEST_P(Estimator, SigmaIsWhatBracketsScatter) {
  // From far below the read noise to where the shortest frame stands alone.
  for (const double electrons : {0.02, 0.4, 3.0, 40.0, 210.0, 700.0, 2900.0, 11000.0}) {
    const Scatter found = ScatterOf(GetParam(), electrons);
    const double draws = static_cast<double>(kSamplesAcross) * kSamplesDown;
    const double chance = 4.5 * std::sqrt(2.0 / draws);
    EXPECT_NEAR(found.claimed / found.variance, 1.0, chance + 0.01) << electrons;
    // Signals below black count as none, and frames that contradict each other by chance are given
    // a wide sigma: the mean variance is a little more than it need be, never less.
    EXPECT_GT(found.claimed_mean / found.variance, 0.99 - chance) << electrons;
    EXPECT_LT(found.claimed_mean / found.variance, 1.08 + chance) << electrons;
    EXPECT_NEAR(found.variance / ExpectedVariance(GetParam(), electrons), 1.0, chance + 0.02)
        << electrons;
    EXPECT_NEAR(found.mean, electrons, 4.5 * std::sqrt(found.variance / draws) + 1e-4 * electrons)
        << electrons;
  }
}
INSTANTIATE_TEST_SUITE_P(Of, Estimator,
                         ::testing::Values(MergeEstimator::kLikelihood, MergeEstimator::kSums,
                                           MergeEstimator::kLongest),
                         [](const auto& tested) {
                           return std::string(
                               kMergeEstimatorWords[static_cast<std::size_t>(tested.param)]);
                         });

TEST(Estimators, OfUnequalSensitivitiesSumsWeighByElectrons) {
  // The second frame's codes stand for a quarter of the electrons (ISO 400): y and g both times 4.
  std::mt19937_64 random(7);
  Frame plain = Exposed(2000.0, random), pushed = Exposed(2000.0, random);
  std::vector<SignalFrame> signals = {*SignalOf(plain), *SignalOf(pushed)};
  for (auto& lanes : signals[1].scale) {
    for (float& scale : lanes) scale *= 4.0F;
  }
  signals[1].clip.fill(4.0F);
  MergePlan plan;
  plan.exposure = {1.0, 4.0};
  const double read = kRead * kRead / (kFullWell * kFullWell);
  plan.noise = {{1.0 / kFullWell, read}, {4.0 / kFullWell, 16.0 * read}};
  plan.fixed_pattern = 0.0;
  plan.estimator = MergeEstimator::kSums;
  const auto merger = BracketMerger::Make(signals, plan);
  std::vector<float> value(kSamplesAcross), variance(kSamplesAcross);
  static_cast<void>(merger->MergeRows(0, 1, View2d<float>(value.data(), kSamplesAcross, 1),
                                      View2d<float>(variance.data(), kSamplesAcross, 1)));
  // Two frames of 2000 electrons each: twice the information of one.
  for (const float v : variance) {
    EXPECT_NEAR(kFullWell * kFullWell * double{v}, 0.5 * (2000.0 + kRead * kRead), 90.0);
  }
}

}  // namespace
}  // namespace lightcal
