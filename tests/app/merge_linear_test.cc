// SPDX-License-Identifier: Apache-2.0
// lightcal merge on scene-linear EXR frames, which carry neither levels nor, often, exposures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "merge_brackets.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests

constexpr int kWidth = 96, kHeight = 64;
const Words kExposures = {"--exposures", "1/60,1/15,1/4", "--f-number", "8", "--iso", "100"};

// A ramp over a factor of 80, exposed 1 : 3.9 : 16.3 (labels 1 : 4 : 16), cut off at `clip`.
Words RampFrames(const test::TempDir& folder, float clip) {
  std::mt19937_64 random(3);
  std::normal_distribution<float> noise(0.0F, 1.0F);
  Words files;
  for (const float exposure : {1.0F, 3.9F, 16.3F}) {
    std::vector<float> samples;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      for (const float tint : {0.9F, 1.0F, 0.8F}) {
        const float scene = 0.01F * std::pow(80.0F, static_cast<float>(i % kWidth) / kWidth);
        const float signal = scene * tint * exposure;
        const float seen = signal + std::sqrt(signal / 2e4F + 1e-8F) * noise(random);
        samples.push_back(std::min(seen, clip));
      }
    }
    files.push_back(folder.path() + "/" + std::to_string(files.size()) + ".exr");
    devices::ExrPicture exr;
    exr.samples = View2d<const float>(samples.data(), kWidth, kHeight, 3);
    exr.channel_names = {"R", "G", "B"};
    exr.chromaticities = PrimariesOf(RgbSpace::kSrgb);
    EXPECT_TRUE(devices::WriteExr(files.back(), exr).has_value());
  }
  return files;
}

class LinearFrames : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(MergeCommand, LinearFrames, testing::Values(1.0F, 1e6F),
                         [](const auto& clip) {
                           return std::string(clip.param > 1.0F ? "Unclipped" : "Clipped");
                         });

// Both exposures and noise are measured, whether or not a clip shows itself.
TEST_P(LinearFrames, MergeUnderTheExposuresGiven) {
  const test::TempDir folder;
  const std::string output = folder.path() + "/lum.exr";
  const json answer = MergeJson(RampFrames(folder, GetParam()), output, kExposures);
  EXPECT_NEAR(answer["frames"][1]["ratio_ev"], std::log2(3.9), 0.003);
  EXPECT_NEAR(answer["frames"][2]["ratio_ev"], std::log2(16.3), 0.003);
  EXPECT_EQ(answer["clipped_fraction"], 0.0);
  EXPECT_EQ(answer["noise"]["source"], "estimated");
  EXPECT_NEAR(answer["noise"]["scale"].get<double>() * 2e4, 1.0, 0.15);
  const Picture lum = ReadExr(output);
  const double first = lum.Mean(2, 0, 1, kHeight);
  for (const int x : {20, 50, 80, 93}) {
    EXPECT_NEAR(lum.Mean(x, 0, 1, kHeight) / first, std::pow(80.0, (x - 2) / 96.0),
                0.006 * std::pow(80.0, (x - 2) / 96.0))
        << x;
  }
}

}  // namespace
}  // namespace lightcal
