// SPDX-License-Identifier: Apache-2.0
// A 68 % interval must hold the truth as often as it says: many small brackets, each with its own
// shutters, pixels and noise.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "merge_truth.h"

namespace lightcal {
namespace {

using test::StepWedge;
using test::SyntheticCamera;

TEST(BracketMerger, IntervalsHoldOverTwoThousandSmallBrackets) {
  double covered = 0.0, count = 0.0;
  for (int seed = 1; seed <= 2000; ++seed) {
    SyntheticCamera camera = test::FlawedCamera(64, 64);
    camera.pixel_seed = static_cast<std::uint64_t>(seed);
    const StepWedge wedge{test::LogSteps(0.5, 4e4, 16), 4, 64, 64};
    const auto series =
        test::ExposureSeries(1.0 / 2048, 5, 2.0, 8.0, 0.03, static_cast<std::uint64_t>(seed));
    const auto frames = test::ShootBracket(camera, series, wedge.Scene());
    const auto merged = test::MergeSamples(frames, test::RequestOf(series));
    ASSERT_TRUE(merged.has_value()) << merged.error().message;
    // The scale from the true exposures: what is asked here are the pixels' own intervals.
    double gauge = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      gauge +=
          merged->planned.ln_exposure[i] - std::log(TrueExposure(series[merged->planned.order[i]]));
    }
    const double first = std::exp(merged->planned.ln_exposure[0] - gauge / 5.0);
    const double per_nit = first / TrueExposure(series[0]) / SaturatingNits(camera, series[0]);
    for (const test::Patch& patch : test::PatchesOf(wedge, *merged, per_nit)) {
      covered += patch.covered * patch.count;
      count += patch.count;
    }
  }
  EXPECT_GT(covered / count, 0.65);
  EXPECT_LT(covered / count, 0.71);
}

}  // namespace
}  // namespace lightcal
