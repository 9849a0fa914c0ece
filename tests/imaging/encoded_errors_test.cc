// SPDX-License-Identifier: Apache-2.0
// What a merge of codes says of its own errors, against errors that were put in.
#include "lightcal/imaging/bracket/encoded_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "compressed_codes.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/merge_bracket.h"
#include "lightcal/imaging/bracket/merge_picture.h"
#include "lightcal/imaging/bracket/plan_merge.h"
#include "lightcal/imaging/bracket/response.h"

namespace lightcal {
namespace {

// Frames of pixels with three channels, two stops apart, each wrong by its share of `off`; the
// noise of a pixel's channels has the correlation `shared`.
SampledSignals Sampled(const std::vector<double>& off, double sd, double shared) {
  constexpr std::size_t kPixels = 40'000;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  SampledSignals signals;
  signals.clip.assign(3 * kPixels, 1.0F);
  for (std::size_t k = 0; k < off.size(); ++k) {
    auto& frame = signals.frames.emplace_back();
    for (std::size_t i = 0; i < kPixels; ++i) {
      const double x = std::exp(-6.0 + 6.0 * static_cast<double>(i) / kPixels);
      const double common = normal(random);
      for (int c = 0; c < 3; ++c) {
        const double n = std::sqrt(shared) * common + std::sqrt(1.0 - shared) * normal(random);
        const double y = x * std::exp2(2.0 * static_cast<double>(k)) / 64.0 * std::exp(off[k]);
        frame.push_back(static_cast<float>(std::min(1.0, y + sd * n)));
      }
    }
  }
  return signals;
}

MergePlan TwoStopsApart(std::size_t frames, double sd) {
  MergePlan plan;
  for (std::size_t k = 0; k < frames; ++k) {
    plan.exposure.push_back(std::exp2(2.0 * static_cast<double>(k)));
  }
  plan.noise.assign(frames, {1e-12, sd * sd});
  return plan;
}

TEST(CurveMisfit, IsWhatMostLevelsOfNeighboursAreOffBy) {
  const std::vector<double> off = {0.0, 0.012, -0.004, 0.01};
  constexpr double kSd = 1e-3;
  const auto plan = TwoStopsApart(off.size(), kSd);
  const double misfit = CurveMisfit(Sampled(off, kSd, 0.0), 3, plan);
  // Frames differ by .012, .016 and .014; the middle one, as a standard deviation of one frame.
  EXPECT_NEAR(misfit, 1.4826 * 0.014 / std::sqrt(2.0), 5e-4);
}

TEST(CurveMisfit, OfFramesThatAgreeIsNoneWhateverTheirNoise) {
  constexpr double kSd = 5e-3;
  const auto signals = Sampled({0.0, 0.0, 0.0}, kSd, 0.0);
  EXPECT_LT(CurveMisfit(signals, 3, TwoStopsApart(3, kSd)), 5e-4);
}

TEST(SharedNoise, IsTheChannelsCorrelation) {
  constexpr double kSd = 2e-3;
  for (const double shared : {0.0, 0.3, 0.8}) {
    const auto signals = Sampled({0.0, 0.0, 0.0}, kSd, shared);
    EXPECT_NEAR(SharedNoise(signals, 3, TwoStopsApart(3, kSd)), shared, 0.03);
  }
  EXPECT_EQ(SharedNoise(Sampled({0.0, 0.0}, kSd, 0.5), 1, TwoStopsApart(2, kSd)), 0.0);
}

constexpr int kWidth = 240, kHeight = 160;

// Plain patches in the left half, texture of 8 % in the right one; over two decades.
std::vector<double> PatchesAndTexture(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<double> scene;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double level = std::exp2(-6.0 + (x / 24 % 5) + (y / 32) * 0.7);
      scene.push_back(level * (x < kWidth / 2 ? 1.0 : std::exp(0.08 * normal(random))));
    }
  }
  return scene;
}

std::vector<Frame> Photographs(const std::vector<double>& scene,
                               const std::vector<double>& exposure, double step,
                               std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<Frame> frames;
  for (const double told : exposure) {
    const double t = told * std::exp(0.004 * normal(random));
    std::vector<double> codes;
    for (const double x : scene) {
      for (int c = 0; c < 3; ++c) {
        const double signal = t * x + std::sqrt(t * x * 5e-5) * normal(random);
        codes.push_back(255.0 * std::pow(std::clamp(signal, 0.0, 1.0), 1.0 / 2.2));
      }
    }
    for (int c = 0; c < 3; ++c) test::Compress(codes, kWidth, c, step);
    auto kept = std::make_shared<std::vector<std::uint16_t>>();
    for (const double code : codes) {
      kept->push_back(static_cast<std::uint16_t>(std::lround(std::clamp(code, 0.0, 255.0))));
    }
    Frame frame;
    frame.info.file = "frame.jpg";
    frame.info.width = kWidth;
    frame.info.height = kHeight;
    frame.info.channels = 3;
    frame.info.meaning = SampleMeaning::kEncoded;
    SensorLevels levels;
    levels.black = {1, 1, {0.0F}};
    levels.white.fill(255.0F);
    frame.info.levels = levels;
    frame.samples = View2d<const std::uint16_t>(kept->data(), kWidth, kHeight, 3);
    frame.owner = kept;
    frames.push_back(std::move(frame));
  }
  return frames;
}

struct Half {
  std::vector<double> errors, sigmas;  // relative
  // Share of pixels whose error lies within two sigma.
  [[nodiscard]] double Within() const {
    double within = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      within += std::abs(errors[i]) < 2.0 * sigmas[i] ? 1.0 : 0.0;
    }
    return within / static_cast<double>(errors.size());
  }
  // The median sigma over the sigma that the median error has.
  [[nodiscard]] double ToldOverFound() const {
    std::vector<double> sizes, told = sigmas;
    for (const double error : errors) sizes.push_back(std::abs(error));
    return UpperMedian(told) / (1.4826 * UpperMedian(sizes));
  }
};

// The plain and the textured half of a merged scene; a scale in common is left out.
std::array<Half, 2> HalvesOf(unsigned seed, double step) {
  std::mt19937_64 random(seed);
  const auto scene = PatchesAndTexture(random);
  const std::vector<double> exposure = {0.25, 1.0, 4.0, 16.0};
  const auto frames = Photographs(scene, exposure, step, random);
  const auto curves = RecoverResponse(frames, exposure);
  EXPECT_TRUE(curves.has_value());
  std::vector<SignalFrame> signals;
  for (const Frame& frame : frames) signals.push_back(*SignalOf(frame, &curves->curves));
  MergeRequest request;
  for (const double ln : curves->exposures.ln_exposure) {
    request.label_exposure.push_back(std::exp(ln));
  }
  request.power_sd = curves->exposures.power_sd;
  request.keep_labels = true;
  const auto planned = PlanMerge(signals, request);
  EXPECT_TRUE(planned.has_value());
  const auto merger = BracketMerger::Make(signals, planned->plan);
  std::vector<float> picture(scene.size()), sigma(scene.size());
  const std::array<double, 3> luminance = {0.2126, 0.7152, 0.0722};
  EXPECT_TRUE(MergePicture(*merger, {.picture = {luminance}, .luminance = luminance}, 0, kHeight,
                           View2d<float>(picture.data(), kWidth, kHeight),
                           View2d<float>(sigma.data(), kWidth, kHeight)));
  std::vector<double> errors;
  for (std::size_t i = 0; i < scene.size(); ++i) errors.push_back(std::log(picture[i] / scene[i]));
  std::vector<double> sorted = errors;
  const double middle = UpperMedian(sorted);
  std::array<Half, 2> halves;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    Half& half = halves[static_cast<int>(i) % kWidth < kWidth / 2 ? 0 : 1];
    const double relative = sigma[i] / picture[i];
    if (!(relative < 0.5)) continue;
    half.errors.push_back(errors[i] - middle);
    half.sigmas.push_back(relative);
  }
  return halves;
}

TEST(EncodedErrors, SigmaOfPlainPartsIsThatOfTheirErrorsAndOfTextureNoSmaller) {
  for (const double step : {1.0, 4.0, 10.0}) {
    for (unsigned seed = 100; seed < 103; ++seed) {
      const auto [plain, textured] = HalvesOf(seed, step);
      EXPECT_GT(plain.Within(), 0.92) << step;
      EXPECT_GT(plain.ToldOverFound(), 0.8) << step;
      EXPECT_LT(plain.ToldOverFound(), 2.0) << step;
      EXPECT_GT(textured.Within(), 0.92) << step;
    }
  }
}

TEST(EncodedErrors, EdgesAreLessSureThanWhatLiesBesideThem) {
  const auto halves = HalvesOf(7, 1.0);
  std::vector<double> sigmas = halves[0].sigmas;
  const double middle = UpperMedian(sigmas);
  EXPECT_GT(AtRank(sigmas, sigmas.size() * 99 / 100), 3.0 * middle);
}

}  // namespace
}  // namespace lightcal
