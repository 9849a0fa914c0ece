// SPDX-License-Identifier: Apache-2.0
// lightcal merge on frames of cine cameras: T-stops, shutter angles, OpenEXR's attributes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "merge_brackets.h"
#include "plain_exr.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests
using test::BytesOf;
using test::ExrAttribute;
using test::FloatOf;

constexpr int kSize = 64;

// A ramp and its noise; the brightest sample is 0.9 of `exposure`.
std::string Frame(float exposure, std::uint64_t seed, const std::vector<ExrAttribute>& attributes) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> noise(0.0F, 1.0F);
  std::vector<float> samples;
  for (int i = 0; i < kSize * kSize; ++i) {
    const float signal = exposure * 0.9F * static_cast<float>(i % kSize + 1) / kSize;
    samples.push_back(signal + std::sqrt(signal / 2e4F + 1e-8F) * noise(random));
  }
  return test::EncodeExr(kSize, kSize, samples, attributes);
}

ExrAttribute Rate(std::int32_t frames, std::uint32_t seconds) {
  return {"framesPerSecond", "rational", BytesOf(frames, seconds)};
}
ExrAttribute Counter(std::int32_t number) { return {"imageCounter", "int", BytesOf(number)}; }

// 172.8 and 86.4 degrees at 24 frames a second: 1/50 and 1/100 s exactly, where a dial's label 1/50
// means 1/50.8.
TEST(MergeCine, ShutterAnglesAndTStopsGiveTheExposure) {
  const test::TempDir folder;
  const auto tags = [](float angle, int number) {
    return std::vector{FloatOf("shutterAngle", angle), Rate(24, 1), FloatOf("tStop", 2.9F),
                       FloatOf("isoSpeed", 800.0F), Counter(number)};
  };
  const Words files = {folder.Write("a.exr", Frame(0.5F, 1, tags(86.4F, 7))),
                       folder.Write("b.exr", Frame(1.0F, 2, tags(172.8F, 8)))};
  const std::string output = folder.path() + "/lum.exr";
  const json answer = MergeJson(files, output);
  EXPECT_FALSE(Warns(answer, "exposure_tags_disagree")) << answer.dump();
  const json& frame = answer["frames"][1];
  EXPECT_NEAR(frame["exposure_s"].get<double>(), 0.02, 1e-7);
  EXPECT_NEAR(frame["t_stop"].get<double>(), 2.9, 1e-6);
  EXPECT_NEAR(frame["shutter_angle_deg"].get<double>(), 172.8, 1e-4);
  EXPECT_EQ(frame["frames_per_second"], 24.0);
  EXPECT_EQ(frame["image_counter"], 8);
  EXPECT_FALSE(frame.contains("f_number"));
  // L = 78/S N^2/(q t) with the transmittance out of q: q/0.9 = 0.722 and N = T.
  const double nits = 78.0 / 800.0 * 2.9 * 2.9 / (0.65 / 0.9 * 0.01);
  EXPECT_NEAR(answer["scale"]["nits_per_unit"].get<double>() / nits, 1.0, 0.01);
  const json typed = MergeJson(files, output, {"--t-stop", "T5.8", "--force"});
  EXPECT_NEAR(typed["scale"]["nits_per_unit"].get<double>() / nits, 4.0, 0.04);
}

TEST(MergeCine, ContradictionsAreNamedAndNeitherSideIsBelieved) {
  const test::TempDir folder;
  const auto refused = [&](const std::vector<ExrAttribute>& tags, const std::string& about) {
    const Words files = {folder.Write("a.exr", Frame(0.5F, 1, tags)),
                         folder.Write("b.exr", Frame(1.0F, 2, tags))};
    ExpectRefused(files, folder.path() + "/lum.exr", "no_exposure_metadata");
    const json answer = MergeJson(files, folder.path() + "/lum.exr",
                                  {"--exposures", "1/100,1/50", "--f-number", "4", "--force"});
    EXPECT_TRUE(Warns(answer, "exposure_tags_disagree")) << about;
    std::filesystem::remove(folder.path() + "/lum.exr");
  };
  refused({FloatOf("shutterAngle", 180.0F), Rate(24, 1), FloatOf("expTime", 0.01F),
           FloatOf("aperture", 4.0F), FloatOf("isoSpeed", 800.0F)},
          "angle and time");
  refused({FloatOf("expTime", 0.01F), FloatOf("aperture", 5.6F), FloatOf("tStop", 2.9F),
           FloatOf("isoSpeed", 800.0F)},
          "T-stop below the f-number");
}

// 50 mm focused at 1 m: (1 + m)^2 = 1.108 more luminance for the same exposure.
TEST(MergeCine, FocusingNearIsCorrectedWhereTheDistanceIsKnown) {
  const test::TempDir folder;
  std::vector<ExrAttribute> tags = {FloatOf("expTime", 0.125F), FloatOf("aperture", 4.0F),
                                    FloatOf("isoSpeed", 100.0F)};
  const auto nits = [&] {
    const Words files = {folder.Write("a.exr", Frame(1.0F, 1, tags))};
    return MergeJson(files, folder.path() + "/lum.exr",
                     {"--noise", "5e-5,1e-8", "--force"})["scale"]["nits_per_unit"]
        .get<double>();
  };
  const double far = nits();
  tags.push_back(FloatOf("focus", 1.0F));
  tags.push_back(FloatOf("nominalFocalLength", 50.0F));
  EXPECT_NEAR(nits() / far, std::pow(1.0 + 0.05 / 0.95, 2), 1e-6);
}

}  // namespace
}  // namespace lightcal
