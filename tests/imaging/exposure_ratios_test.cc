// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/exposure_ratios.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "merge_truth.h"

namespace lightcal {
namespace {

using test::StepWedge;
using test::SyntheticCamera;
using test::SyntheticExposure;

SyntheticCamera Camera() { return test::FlawedCamera(300, 200); }

Result<ExposureRatios> Measure(const std::vector<Frame>& frames, const std::vector<double>& label) {
  std::vector<SignalFrame> signals;
  std::vector<std::string> names;
  for (const Frame& frame : frames) {
    signals.push_back(*SignalOf(frame));
    names.push_back(frame.info.file);
  }
  FindClipping(signals);
  return MeasureExposureRatios(SampleRows(signals, 1'000'000), label, names);
}

std::vector<double> Labels(const std::vector<SyntheticExposure>& series) {
  std::vector<double> labels;
  for (const SyntheticExposure& exposure : series) labels.push_back(LabelExposure(exposure));
  return labels;
}

// Largest difference between found and true ln exposures, their common factor left out.
double Spread(const ExposureRatios& ratios, const std::vector<SyntheticExposure>& series) {
  std::vector<double> off;
  for (std::size_t i = 0; i < series.size(); ++i) {
    off.push_back(ratios.ln_exposure[i] - std::log(TrueExposure(series[i])));
  }
  const auto [low, high] = std::minmax_element(off.begin(), off.end());
  return *high - *low;
}

TEST(ExposureRatios, AreUnbiasedOverManyShuttersWithTheirClaimedPrecision) {
  double z2 = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const StepWedge wedge{test::LogSteps(1.0, 2e4, 24), 6, 300, 200};
    const auto series = test::ExposureSeries(1.0 / 1024, 5, 2.0, 8.0, 0.03, seed);
    const auto ratios =
        Measure(test::ShootBracket(Camera(), series, wedge.Scene()), Labels(series));
    ASSERT_TRUE(ratios.has_value()) << ratios.error().message;
    EXPECT_LT(Spread(*ratios, series), 0.004);
    for (std::size_t i = 1; i < series.size(); ++i) {
      const double off = ratios->ln_exposure[i] - ratios->ln_exposure[0] -
                         std::log(TrueExposure(series[i]) / TrueExposure(series[0]));
      z2 += off * off / (ratios->sd_ln[i] * ratios->sd_ln[i]);
      count += 1.0;
    }
  }
  EXPECT_GT(z2 / count, 0.4);
  EXPECT_LT(z2 / count, 1.8);
}

// Codes that the black level is off by are no sensor that bends; nor do they hide one that does.
TEST(ExposureRatios, ABlackLevelThatIsOffIsNoBend) {
  const StepWedge wedge{test::LogSteps(1.0, 2e4, 24), 6, 300, 200};
  for (const double off_dn : {0.0, 1.0, 2.0, 3.0, -1.0, -3.0}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SyntheticCamera camera = Camera();
      camera.knee_relative = 0.0;
      camera.black_error_dn = {off_dn, off_dn, off_dn};
      const auto series = test::ExposureSeries(1.0 / 1024, 5, 2.0, 8.0, 0.03, seed);
      const auto straight =
          Measure(test::ShootBracket(camera, series, wedge.Scene()), Labels(series));
      ASSERT_TRUE(straight.has_value()) << straight.error().message;
      EXPECT_EQ(straight->linear_to, 0.9) << off_dn << " DN, seed " << seed;
      camera.knee_relative = 0.05;
      const auto bent = Measure(test::ShootBracket(camera, series, wedge.Scene()), Labels(series));
      ASSERT_TRUE(bent.has_value()) << bent.error().message;
      EXPECT_LT(bent->linear_to, 0.9) << off_dn << " DN, seed " << seed;
      EXPECT_GT(bent->linear_to, 0.75) << off_dn << " DN, seed " << seed;
    }
  }
}

// Half of the picture clips in all frames but the first.
TEST(ExposureRatios, DoNotMindClipping) {
  const auto series = test::ExposureSeries(1.0 / 1024, 4, 2.0, 8.0, 0.03, 11);
  const auto scene = [](int x, int y) {
    return test::XyzOf(x < 150 ? 6e4 : 30.0 * std::pow(10.0, 2.5 * y / 200.0));
  };
  const auto ratios = Measure(test::ShootBracket(Camera(), series, scene), Labels(series));
  ASSERT_TRUE(ratios.has_value()) << ratios.error().message;
  EXPECT_LT(Spread(*ratios, series), 0.003);
}

// A tenth of the picture is another scene in every frame.
TEST(ExposureRatios, DoNotMindPeopleWalkingThrough) {
  const auto series = test::ExposureSeries(1.0 / 1024, 4, 2.0, 8.0, 0.03, 12);
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const int at = 40 + 70 * static_cast<int>(i);
    const auto scene = [at](int x, int y) {
      const bool person = std::abs(x - at) < 15;
      return test::XyzOf(person ? 200.0 : 100.0 * std::pow(10.0, 2.0 * y / 200.0));
    };
    frames.push_back(test::FrameOf(Camera(), series[i], Expose(Camera(), series[i], scene), "f"));
  }
  const auto ratios = Measure(frames, Labels(series));
  ASSERT_TRUE(ratios.has_value()) << ratios.error().message;
  EXPECT_LT(Spread(*ratios, series), 0.003);
}

// Patches of fifteen stops with their edges elsewhere in one frame: its exposure is what the
// insides show.
TEST(ExposureRatios, DoNotMindACameraThatMovedBetweenTwoFrames) {
  const auto series = test::ExposureSeries(1.0 / 1024, 5, 2.0, 8.0, 0.03, 16);
  auto steps = test::LogSteps(0.5, 2e4, 40);
  std::shuffle(steps.begin(), steps.end(), std::mt19937_64(5));
  const StepWedge wedge{steps, 10, 300, 200};
  const auto still = wedge.Scene();
  for (const int moved : {2, 8}) {
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const int by = i == 2 ? moved : 0;
      const auto scene = [&](int x, int y) { return still(std::max(0, x - by), y); };
      frames.push_back(test::FrameOf(Camera(), series[i], Expose(Camera(), series[i], scene), "f"));
    }
    const auto ratios = Measure(frames, Labels(series));
    ASSERT_TRUE(ratios.has_value()) << ratios.error().message;
    EXPECT_LT(Spread(*ratios, series), 0.01) << moved << " pixels";
  }
}

TEST(ExposureRatios, AThirdOfAStopOffItsLabelIsCorrectedAndSaid) {
  auto series = test::ExposureSeries(1.0 / 1024, 4, 2.0, 8.0, 0.0, 13);
  series[2].true_time_s *= 1.3;
  const StepWedge wedge{test::LogSteps(10.0, 2e4, 24), 6, 300, 200};
  const auto ratios = Measure(test::ShootBracket(Camera(), series, wedge.Scene()), Labels(series));
  ASSERT_TRUE(ratios.has_value()) << ratios.error().message;
  EXPECT_LT(Spread(*ratios, series), 0.003);
  ASSERT_EQ(ratios->warnings.size(), 1U);
  EXPECT_EQ(ratios->warnings[0].code, "exposure_off");
  EXPECT_EQ(ratios->warnings[0].subject, "frame_2");
}

TEST(ExposureRatios, FramesThatShareNothingKeepTheirLabels) {
  const auto series = test::ExposureSeries(1.0 / 4096, 2, 11.0, 8.0, 0.0, 14);
  const StepWedge wedge{{3e4, 5e4, 30.0, 60.0}, 2, 300, 200};
  const auto ratios = Measure(test::ShootBracket(Camera(), series, wedge.Scene()), Labels(series));
  ASSERT_TRUE(ratios.has_value()) << ratios.error().message;
  EXPECT_FALSE(ratios->measured[0]);
  EXPECT_NEAR(ratios->ln_exposure[1] - ratios->ln_exposure[0], 11.0 * std::log(2.0), 1e-6);
  ASSERT_FALSE(ratios->warnings.empty());
  EXPECT_EQ(ratios->warnings[0].code, "ratio_from_label");
}

TEST(ExposureRatios, ShuffledLabelsAreRefused) {
  const auto series = test::ExposureSeries(1.0 / 1024, 3, 2.0, 8.0, 0.0, 15);
  const StepWedge wedge{test::LogSteps(10.0, 2e4, 24), 6, 300, 200};
  auto labels = Labels(series);
  std::swap(labels[0], labels[2]);
  const auto ratios = Measure(test::ShootBracket(Camera(), series, wedge.Scene()), labels);
  ASSERT_FALSE(ratios.has_value());
  EXPECT_EQ(ratios.error().code, "exposures_disagree");
}

}  // namespace
}  // namespace lightcal
