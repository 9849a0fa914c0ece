// SPDX-License-Identifier: Apache-2.0
// Pictures made smaller: means are the means of the codes, half of a lamp is clipped, sigma is what
// brackets scatter, and places stay where they are.
#include "lightcal/imaging/bracket/thin_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/imaging/bracket/sample_corrections.h"
#include "merge_truth.h"

namespace lightcal {
namespace {

using test::StepWedge;
using test::SyntheticCamera;
using test::SyntheticExposure;

PictureChoice Averaged(int n) {
  PictureChoice choice;
  choice.pixel_stride = n;
  choice.average_pixels = true;
  return choice;
}

// A camera without flaws.
SyntheticCamera Plain(int width, int height) {
  SyntheticCamera camera;
  camera.width = width;
  camera.height = height;
  return camera;
}

struct Bracket {
  std::vector<Frame> frames;
  std::vector<SignalFrame> signals;
};

Bracket AveragedBracket(std::vector<Frame> frames, int n) {
  Bracket out;
  const Thinning thinning = ThinningOf(frames.front().info, Averaged(n));
  for (const Frame& frame : frames) out.signals.push_back(*SignalOf(frame));
  FindClipping(out.signals);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    AverageFrame(thinning, frames[i], out.signals[i]);
  }
  out.frames = std::move(frames);
  return out;
}

// Signal of the pixel by the camera's own levels.
double SignalAt(const SyntheticCamera& camera, const Frame& frame, int x, int y) {
  const double code = std::get<View2d<const std::uint16_t>>(frame.samples)(x, y);
  return (code - camera.black_dn) / (camera.white_dn - camera.black_dn);
}

class AveragedMosaic : public ::testing::TestWithParam<int> {};

TEST_P(AveragedMosaic, SamplesAreTheMeansOfTheirPlaceInThePattern) {
  for (const bool x_trans : {false, true}) {
    SyntheticCamera camera = test::FlawedCamera(96, 72);
    camera.x_trans = x_trans;
    const int period = x_trans ? 6 : 2, n = GetParam();
    const StepWedge wedge{test::LogSteps(1.0, 200.0, 8), 4, 96, 72};
    std::vector<Frame> frames = test::ShootBracket(camera, {SyntheticExposure{}}, wedge.Scene());
    frames[0].info.cfa = {period, period, {}};
    for (int i = 0; i < period * period; ++i) {
      frames[0].info.cfa.values.push_back(
          static_cast<std::uint8_t>(FilterAt(camera, i % period, i / period)));
    }
    const Bracket small = AveragedBracket(frames, n);
    const auto& samples = std::get<View2d<const float>>(small.frames[0].samples);
    ASSERT_EQ(samples.width(), 96 / (period * n) * period);
    ASSERT_EQ(samples.height(), 72 / (period * n) * period);
    for (int y = 0; y < samples.height(); ++y) {
      for (int x = 0; x < samples.width(); ++x) {
        double sum = 0.0;
        for (int j = 0; j < n; ++j) {
          for (int i = 0; i < n; ++i) {
            sum += SignalAt(camera, frames[0], (x / period * n + i) * period + x % period,
                            (y / period * n + j) * period + y % period);
          }
        }
        ASSERT_NEAR(samples(x, y), sum / (n * n), 2e-7) << x << "," << y;
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Of, AveragedMosaic, ::testing::Values(2, 3, 4),
                         [](const auto& tested) { return std::to_string(tested.param); });

// Luminances of the merged, averaged bracket's greens, where a patch of one luminance is.
struct Found {
  PlannedMerge planned;
  std::vector<float> value, variance;
  std::size_t clipped = 0;
};
Found MergeAveraged(const Bracket& bracket, MergeRequest request, int n) {
  Found out;
  std::vector<SignalFrame> signals = bracket.signals;
  request.samples_averaged = n;
  out.planned = *PlanMerge(signals, request);
  const auto merger = BracketMerger::Make(signals, out.planned.plan);
  const auto width = static_cast<int>(signals[0].row_samples());
  out.value.resize(signals[0].row_samples() * static_cast<std::size_t>(signals[0].height));
  out.variance.resize(out.value.size());
  out.clipped = merger->MergeRows(0, signals[0].height,
                                  View2d<float>(out.value.data(), width, signals[0].height),
                                  View2d<float>(out.variance.data(), width, signals[0].height));
  return out;
}

TEST(AverageFrame, ABlockWithOneClippedSampleIsClippedThereAndTrueByTheShorterFrame) {
  // A lamp of one pixel, four times too bright for the longer frame, on a wall of a fortieth of it.
  const SyntheticCamera camera = Plain(192, 192);
  const auto series = test::ExposureSeries(1.0 / 512, 2, 4.0, 8.0, 0.0, 5);
  const double top = SaturatingNits(camera, series[1]);
  const auto is_lamp = [](int x, int y) { return x % 24 == 5 && y % 24 == 7; };
  const auto frames = test::ShootBracket(camera, series, [&](int x, int y) {
    return test::XyzOf(is_lamp(x, y) ? 4.0 * top : 0.1 * top * (1.0 + x / 192.0));
  });
  const Bracket small = AveragedBracket(frames, 2);
  const Found found = MergeAveraged(small, test::RequestOf(series), 2);
  EXPECT_EQ(found.clipped, 0U);
  const auto& longer = std::get<View2d<const float>>(small.frames[1].samples);
  // The whole picture's (5, 7) is a blue of the block that starts at (4, 4).
  for (int y = 3; y < 96; y += 12) {
    for (int x = 3; x < 96; x += 12) {
      const int block_x = x / 12 * 12 + 5 / 4 * 2 + 5 % 2,
                block_y = y / 12 * 12 + 7 / 4 * 2 + 7 % 2;
      EXPECT_EQ(longer(block_x, block_y), small.signals[1].clip[kBlueChannel]);
      double sum = 0.0;
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
          sum += SignalAt(camera, frames[0], (block_x / 2 * 2 + i) * 2 + block_x % 2,
                          (block_y / 2 * 2 + j) * 2 + block_y % 2);
        }
      }
      // The shorter frame alone, not a part of the longer one.
      EXPECT_NEAR(found.value[static_cast<std::size_t>(block_y * 96 + block_x)], sum / 4.0, 1e-6);
    }
  }
}

TEST(AverageFrame, SigmaIsWhatMeansScatterWhoeverKnowsTheNoise) {
  SyntheticCamera camera = Plain(600, 400);
  const auto series = test::ExposureSeries(1.0 / 512, 4, 2.0, 8.0, 0.0, 3);
  const StepWedge wedge{test::LogSteps(0.5, 2e4, 12), 4, 600, 400};
  std::vector<Frame> frames = test::ShootBracket(camera, series, wedge.Scene());
  const double codes = camera.white_dn - camera.black_dn;
  const double electrons = camera.full_well_e;
  const NoiseProfile noise{
      1.0 / electrons, std::pow(camera.read_noise_e / electrons, 2) + 1.0 / (12.0 * codes * codes)};
  for (const int n : {2, 4}) {
    const Bracket small = AveragedBracket(frames, n);
    const int width = small.frames[0].info.width, height = small.frames[0].info.height;
    for (const char* who : {"given", "file", "bracket"}) {
      MergeRequest request = test::RequestOf(series);
      if (*who == 'g') request.noise = noise;
      if (*who == 'f') request.noise_in_file.assign(4, {noise});
      const Found found = MergeAveraged(small, request, n);
      for (int patch = 0; patch < 12; ++patch) {
        double count = 0.0, sum = 0.0, squares = 0.0, claimed = 0.0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const int whole_x = n * x, whole_y = n * y;
            if ((x & 1) == (y & 1) || wedge.PatchAt(whole_x, whole_y) != patch ||
                wedge.PatchAt(std::min(whole_x + 3 * n, 599), whole_y) != patch ||
                wedge.PatchAt(std::max(whole_x - 3 * n, 0), whole_y) != patch ||
                wedge.PatchAt(whole_x, std::min(whole_y + 3 * n, 399)) != patch ||
                wedge.PatchAt(whole_x, std::max(whole_y - 3 * n, 0)) != patch) {
              continue;
            }
            const auto i = static_cast<std::size_t>(y * width + x);
            count += 1.0;
            sum += found.value[i];
            squares += double{found.value[i]} * found.value[i];
            // Pixels are alike here; what might differ is not in the scatter.
            const double pattern = found.planned.plan.fixed_pattern * found.value[i];
            claimed += found.variance[i] - pattern * pattern;
          }
        }
        const double mean = sum / count;
        const double scatter = squares / count - mean * mean;
        EXPECT_NEAR(claimed / count / scatter, 1.0, 5.0 * std::sqrt(2.0 / count) + 0.02)
            << who << " n = " << n << " " << wedge.nits[static_cast<std::size_t>(patch)];
      }
    }
  }
}

TEST(AverageFrame, UnequalPixelsEvenOut) {
  SyntheticCamera camera = Plain(1200, 800);
  camera.prnu_relative = 0.008;
  const auto series = test::ExposureSeries(1.0 / 128, 3, 2.0, 8.0, 0.0, 3);
  const double top = SaturatingNits(camera, series[0]);
  const StepWedge wedge{test::LogSteps(0.05 * top, 0.4 * top, 4), 2, 1200, 800};
  const auto frames = test::ShootBracket(camera, series, wedge.Scene());
  for (const int n : {2, 4}) {
    const Found found = MergeAveraged(AveragedBracket(frames, n), test::RequestOf(series), n);
    EXPECT_NEAR(found.planned.plan.fixed_pattern * n, 0.008, 0.0015) << n;
  }
}

TEST(Thinning, PlacesAreTheMeansOfThoseTheyAreMadeOf) {
  for (const int n : {2, 4}) {
    for (const bool averaged : {false, true}) {
      const Thinning thinning{
          .n = n, .averaged = averaged, .columns = 2, .rows = 3, .width = 48, .height = 48};
      double apart_x = 0.0, apart_y = 0.0;
      for (int at = 0; at < 12; ++at) {
        double x = 0.0, y = 0.0;
        for (int i = 0; i < (averaged ? n : 1); ++i) {
          x += (at / 2 * n + i) * 2 + at % 2 + 0.5;
          y += (at / 3 * n + i) * 3 + at % 3 + 0.5;
        }
        EXPECT_DOUBLE_EQ(thinning.WholeX(at), x / (averaged ? n : 1));
        EXPECT_DOUBLE_EQ(thinning.WholeY(at), y / (averaged ? n : 1));
        apart_x += thinning.ThinX(thinning.WholeX(at)) - (at + 0.5);
        apart_y += thinning.ThinY(thinning.WholeY(at)) - (at + 0.5);
      }
      EXPECT_NEAR(apart_x, 0.0, 1e-12);
      EXPECT_NEAR(apart_y, 0.0, 1e-12);
    }
  }
}

TEST(ThinRegion, ShowsNothingButTheRegionAndNeverNothing) {
  const Thinning thinning{
      .n = 4, .averaged = true, .columns = 2, .rows = 2, .width = 74, .height = 48};
  const Region inside = ThinRegion({11, 16, 40, 33}, thinning);
  EXPECT_EQ(inside.x, 4);
  EXPECT_EQ(inside.width, 8);  // 16 to 47
  EXPECT_EQ(inside.y, 4);
  EXPECT_EQ(inside.height, 8);
  for (const int x : {0, 3, 150, 295, 299}) {
    const Region small = ThinRegion({x, 190, 3, 3}, thinning);
    EXPECT_GE(small.x, 0);
    EXPECT_LE(small.x + small.width, 74);
    EXPECT_LE(small.y + small.height, 48);
    EXPECT_GE(small.width, 1);
    EXPECT_GE(small.height, 1);
  }
}

TEST(SampleCorrections, HotPixelsOfAPictureMadeSmallerAreTheOnesItShows) {
  for (const bool averaged : {false, true}) {
    const Thinning thinning{
        .n = 2, .averaged = averaged, .columns = 2, .rows = 2, .width = 48, .height = 48};
    SampleCorrections corrections(96, 96, 0, 0);
    const std::vector<int> hot = {4, 4, 6, 4, 7, 5, 40, 41};  // blocks 2,2  3,2  3,2  20,20
    corrections.AddHotPixels(hot);
    corrections.SetThinning(thinning);
    // The first and last block of a pair are kept; of the second only their means show anything.
    EXPECT_EQ(corrections.hot_pixels(), averaged ? 3U : 2U);
  }
}

TEST(SampleCorrections, AFlatFieldFollowsTheLensAtAnySize) {
  // 1 - 0.4 r^2 about a centre at (0.1, -0.05) of half the diagonal.
  constexpr double kHalf = 192.0, kDiagonal = kHalf * 1.4142135623730951;
  SyntheticCamera camera = Plain(384, 384);
  camera.lens = [](int x, int y, int) {
    const double r =
        std::hypot((x + 0.5 - kHalf) / kDiagonal - 0.1, (y + 0.5 - kHalf) / kDiagonal + 0.05);
    return 1.0 - 0.4 * r * r;
  };
  CameraFlat flat;
  flat.center = {0.1, -0.05};
  flat.channels.fill({-0.4, 0.0, 0.0});
  const std::vector<SyntheticExposure> series =
      test::ExposureSeries(1.0 / 128, 2, 2.0, 8.0, 0.0, 3);
  const double top = SaturatingNits(camera, series[0]);
  const auto frames =
      test::ShootBracket(camera, series, [&](int, int) { return test::XyzOf(0.2 * top); });
  for (const bool averaged : {false, true}) {
    PictureChoice choice = Averaged(4);
    choice.average_pixels = averaged;
    const Thinning thinning = ThinningOf(frames[0].info, choice);
    Frame small = averaged ? frames[1] : ThinFrame(frames[1], thinning);
    SignalFrame signal = *SignalOf(small);
    AverageFrame(averaged ? thinning : Thinning{}, small, signal);
    SampleCorrections corrections(384, 384, 0, 0);
    corrections.SetFlat(flat);
    corrections.SetThinning(thinning);
    // Greens of the four quarters: alike once the lens is taken out, by 1e-3 of each.
    std::array<double, 4> sums{}, counts{};
    std::vector<float> value(96), variance(96, 1.0F);
    for (int y = 0; y < 96; ++y) {
      ReadSignals(signal, y, 0, value);
      corrections.Apply(signal, y, value.data(), variance.data());
      for (int x = 0; x < 96; ++x) {
        if ((x & 1) == (y & 1)) continue;
        const auto quarter = static_cast<std::size_t>(x / 48 + y / 48 * 2);
        sums[quarter] += value[static_cast<std::size_t>(x)];
        counts[quarter] += 1.0;
      }
    }
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_NEAR(sums[i] / counts[i] / (sums[0] / counts[0]), 1.0, 1.2e-3) << averaged;
    }
  }
}

}  // namespace
}  // namespace lightcal
