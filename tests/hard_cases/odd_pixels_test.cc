// SPDX-License-Identifier: Apache-2.0
// Rows P01 to P12: pictures with too much light, too little, or numbers that are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "half_exr.h"
#include "hard_case.h"
#include "merge_brackets.h"
#include "plain_exr.h"

namespace lightcal::test::hard {
namespace {

using merge::Camera;
using merge::Picture;
using merge::ReadExr;
using merge::Series;
using merge::Shoot;
using merge::ShootAll;
using merge::Wedge;

// `lightcal merge` of these; the merged files are in `folder`.
Answer Merge(const TempDir& folder, Words files, const Words& more = {}) {
  files.insert(files.begin(), "merge");
  files.insert(files.end(), {"-o", folder.path() + "/lum.exr", "--sigma",
                             folder.path() + "/sigma.exr", "--force", "--mains", "none"});
  files.insert(files.end(), more.begin(), more.end());
  Answer answer = Ask(files);
  EXPECT_EQ(std::filesystem::exists(folder.path() + "/lum.exr"), answer.exit_code == 0);
  if (answer.exit_code != 0) return answer;
  for (const char* name : {"/lum.exr", "/sigma.exr"}) {
    for (const float v : ReadExr(folder.path() + name).samples) {
      EXPECT_TRUE(std::isfinite(v)) << name;
      if (!std::isfinite(v)) break;
    }
  }
  return answer;
}

// The median of merged over true luminance, of all patches.
double ScaleOf(const TempDir& folder, const StepWedge& wedge) {
  const Picture picture = ReadExr(folder.path() + "/lum.exr");
  std::vector<double> ratios;
  for (int patch = 0; patch < 8; ++patch) {
    ratios.push_back(merge::PatchMean(picture, wedge, patch) /
                     wedge.nits[static_cast<std::size_t>(patch)]);
  }
  std::sort(ratios.begin(), ratios.end());
  return 0.5 * (ratios[3] + ratios[4]);
}

TEST(HardCaseP, P01ABracketThatIsAllWhiteIsRefused) {
  const TempDir folder;
  const auto files =
      ShootAll(folder, Camera(64, 64), Series(3), [](int, int) { return XyzOf(1e7); });
  ExpectRefused(Merge(folder, files), "all_saturated");
}

TEST(HardCaseP, P02ABracketThatIsAllBlackIsRefused) {
  const TempDir folder;
  const auto files = ShootAll(folder, Camera(64, 64), Series(3), [](int, int) { return XyzOf(0); });
  ExpectRefused(Merge(folder, files), "all_black");
}

// A dim wall with a lamp that outshines every frame in a corner of 20 x 20 pixels.
SyntheticScene WithLamp() {
  return [](int x, int y) { return x < 20 && y < 20 ? XyzOf(1e7) : merge::Posts(0.0)(x, y); };
}

TEST(HardCaseP, P03OneFrameSaysWhatIsClipped) {
  const TempDir folder;
  const SyntheticCamera camera = Camera();
  const Answer answer = Merge(folder, ShootAll(folder, camera, Series(1), WithLamp()));
  ExpectWarned(answer, "one_frame");
  ExpectWarned(answer, "clipped");
  const Picture lum = ReadExr(folder.path() + "/lum.exr");
  const Picture sigma = ReadExr(folder.path() + "/sigma.exr");
  EXPECT_GE(1.96 * sigma.Mean(4, 4, 12, 12) / lum.Mean(4, 4, 12, 12), 1.0);
  EXPECT_LT(sigma.Mean(100, 100, 50, 50) / lum.Mean(100, 100, 50, 50), 0.1);
}

TEST(HardCaseP, P04ALampClippedInEveryFrameIsALowerLimit) {
  const TempDir folder;
  const SyntheticCamera camera = Camera();
  const Answer answer = Merge(folder, ShootAll(folder, camera, Series(3), WithLamp()));
  ExpectWarned(answer, "clipped");
  EXPECT_NEAR(answer.document["clipped_fraction"].get<double>(), 400.0 / (300 * 200), 0.001);
  const Picture lum = ReadExr(folder.path() + "/lum.exr");
  EXPECT_LT(lum.Mean(4, 4, 12, 12), 1e7);
  EXPECT_GE(1.96 * ReadExr(folder.path() + "/sigma.exr").Mean(4, 4, 12, 12),
            lum.Mean(4, 4, 12, 12));
}

// 64 x 32 cd/m^2 between 100 and 106 with one odd sample.
std::string OddExr(float odd) {
  std::vector<float> samples;
  for (int i = 0; i < 64 * 32; ++i) samples.push_back(100.0F + static_cast<float>(i % 7));
  samples[5 * 64 + 5] = odd;
  return EncodeExr(64, 32, samples, {FloatOf("whiteLuminance", 1.0F)});
}

TEST(HardCaseP, P05SamplesThatAreNoNumbersAreMaskedAndCounted) {
  const TempDir folder;
  const auto inspect = [&](float odd, const Words& more = {}) {
    Words words = {"inspect", folder.Write("odd.exr", OddExr(odd)), "--projection", "latlong"};
    words.insert(words.end(), more.begin(), more.end());
    return Ask(words);
  };
  const Answer clean = inspect(105.0F);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float odd : {std::nanf(""), kInfinity, -kInfinity}) {
    const Answer answer = inspect(odd);
    ExpectWarned(answer, "bad_samples");
    for (const char* key : {"min", "median", "max"}) {
      EXPECT_EQ(answer.document["luminance_nits"][key], clean.document["luminance_nits"][key]);
    }
    EXPECT_NEAR(answer.document["luminance_nits"]["mean"].get<double>(),
                clean.document["luminance_nits"]["mean"].get<double>(), 0.005);
    EXPECT_NEAR(answer.document["illuminance_lx"].get<double>() /
                    clean.document["illuminance_lx"].get<double>(),
                1.0, 2e-3);  // one pixel of 2048 is missing
    EXPECT_EQ(inspect(odd, {"--strict"}).exit_code, 3);
    // Away from it, as if it were not there.
    EXPECT_FALSE(Warns(inspect(odd, {"--rect", "20,20,10,10"}), "bad_samples"));
  }
  for (const float harmless : {-0.0F, 1e-40F}) {
    const Answer answer = inspect(harmless);
    ExpectAnswered(answer);
    EXPECT_EQ(answer.document["luminance_nits"]["median"],
              clean.document["luminance_nits"]["median"]);
  }
}

// Two frames of one scene of 20 to 80 cd/m^2, 1 of which is 1/32 of the longer one's samples; what
// `odd` says of a frame's sample stands in its place. Words for a merge of them.
using OddSample = std::function<std::optional<float>(int frame, int x, int y)>;
constexpr int kWide = 96, kHigh = 64;
Words LinearFrames(const TempDir& folder, const OddSample& odd) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Words words;
  for (int frame = 0; frame < 2; ++frame) {
    std::vector<float> samples;
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) {
        const double signal = (20.0 + 60.0 * x / kWide) / 128.0 * (frame == 0 ? 0.25 : 1.0);
        const double noise = std::sqrt(signal * 1e-5 + 1e-8) * normal(random);
        samples.push_back(odd(frame, x, y).value_or(static_cast<float>(signal + noise)));
      }
    }
    const std::string name = "frame_" + std::to_string(frame) + ".exr";
    words.push_back(folder.Write(name, EncodeExr(kWide, kHigh, samples)));
  }
  return words;
}
const Words kLinearExposure = {"--exposures", "1/100,1/25", "--f-number", "8", "--iso", "100"};

TEST(HardCaseP, P05AMergeMasksThemAndIsElsewhereWhatItWas) {
  const TempDir folder, clean_folder;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<std::array<int, 3>> places = {{0, 10, 10}, {1, 30, 10}, {0, 95, 20}, {1, 0, 63},
                                                  {0, 50, 50}, {1, 50, 50}, {0, 51, 50}};
  const std::array<float, 4> bad = {std::nanf(""), kInfinity, -kInfinity, 3e38F};
  const auto odd = [&](int frame, int x, int y) -> std::optional<float> {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] == std::array{frame, x, y}) return bad[i % 4];
    }
    return std::nullopt;
  };
  ExpectAnswered(Merge(clean_folder,
                       LinearFrames(clean_folder, [](int, int, int) { return std::nullopt; }),
                       kLinearExposure));
  const Answer answer = Merge(folder, LinearFrames(folder, odd), kLinearExposure);
  ExpectWarned(answer, "bad_samples");
  EXPECT_EQ(answer.document["masked_pixels"], 6);  // (50, 50) in both frames
  const Picture lum = ReadExr(folder.path() + "/lum.exr");
  const Picture sigma = ReadExr(folder.path() + "/sigma.exr");
  const Picture clean = ReadExr(clean_folder.path() + "/lum.exr");
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) {
      const auto i = static_cast<std::size_t>(y * kWide + x);
      if (odd(0, x, y) || odd(1, x, y)) {
        EXPECT_NEAR(lum.samples[i], clean.samples[i], 6.0F * sigma.samples[i]) << x << "," << y;
        EXPECT_LT(sigma.samples[i], 0.1F * lum.samples[i]);
      } else {
        // Exposure ratio and noise are measured from all samples, seven of which are others now.
        ASSERT_NEAR(lum.samples[i], clean.samples[i], 0.02F * sigma.samples[i]) << x << "," << y;
      }
    }
  }
  // Harmless ones are no reason to warn.
  const Answer harmless = Merge(folder,
                                LinearFrames(folder,
                                             [](int, int x, int y) -> std::optional<float> {
                                               if (x == 10 && y == 10) return -0.0F;
                                               if (x == 20 && y == 10) return 1e-40F;
                                               return std::nullopt;
                                             }),
                                kLinearExposure);
  EXPECT_FALSE(Warns(harmless, "bad_samples"));
}

TEST(HardCaseP, P05ADomeMasksThemToo) {
  const TempDir folder;
  const auto dome = [&](float odd, const Words& more = {}) {
    Words words = {"dome",   folder.Write("odd.exr", OddExr(odd)),
                   "--lux",  "420",
                   "-o",     folder.path() + "/dome",
                   "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return Ask(words);
  };
  const Answer clean = dome(105.0F);
  ExpectAnswered(clean);
  const double factor = clean.document["scale"]["factor"];
  for (const float odd : {std::nanf(""), -std::numeric_limits<float>::infinity()}) {
    const Answer answer = dome(odd);
    ExpectWarned(answer, "bad_samples");
    EXPECT_NEAR(answer.document["scale"]["factor"].get<double>() / factor, 1.0, 1e-4);
    EXPECT_EQ(dome(odd, {"--strict"}).exit_code, 3);
  }
}

TEST(HardCaseP, P06NoiseBelowBlackStaysInTheMean) {
  // No light at all in half of the picture: its mean is 0, not the mean of the positive half.
  const TempDir folder;
  const SyntheticCamera camera = Camera();
  const auto half = [](int x, int y) { return x < 150 ? XyzOf(0.0) : merge::Posts(0.0)(x, y); };
  ExpectAnswered(Merge(folder, ShootAll(folder, camera, Series(3), half)));
  const Picture lum = ReadExr(folder.path() + "/lum.exr");
  const Picture sigma = ReadExr(folder.path() + "/sigma.exr");
  const double noise = sigma.Mean(10, 10, 120, 180);
  EXPECT_LT(*std::min_element(lum.samples.begin(), lum.samples.end()), 0.0F);
  EXPECT_NEAR(lum.Mean(10, 10, 120, 180), 0.0, 0.1 * noise);
}

TEST(HardCaseP, P07AHotPixelIsNamed) {
  const TempDir folder;
  const std::string hot = folder.Write("hot.exr", OddExr(1e30F));
  const Answer whole = Ask({"inspect", hot});
  ExpectAnswered(whole);
  EXPECT_EQ(whole.document["luminance_nits"]["median"], 103.0);
  EXPECT_EQ(whole.document["peak"]["x"], 5);
  EXPECT_EQ(whole.document["peak"]["y"], 5);
  ExpectRefused(Ask({"dome", hot, "--lux", "420", "-o", folder.path() + "/dome"}), "over_range");
  // Beyond what any file of light holds it counts as no number.
  ExpectWarned(Ask({"inspect", folder.Write("worse.exr", OddExr(3e38F))}), "bad_samples");
}

TEST(HardCaseP, P08LabelsOfShuttersAreCorrectedFromTheFrames) {
  // 1/60, 1/15 and 1/4 s on the dial are 2^-6, 2^-4, 2^-2 s.
  const TempDir folder;
  const SyntheticCamera camera = Camera();
  const StepWedge wedge = Wedge(camera, 1.0, 100.0);
  std::vector<SyntheticExposure> series;
  std::uint64_t seed = 8;
  for (const auto& [label, truth] : std::vector<std::pair<double, double>>{
           {1.0 / 60, 1.0 / 64}, {1.0 / 15, 1.0 / 16 * 1.067}, {1.0 / 4, 1.0 / 4 * 0.933}}) {
    SyntheticExposure exposure;
    exposure.label_time_s = label;
    exposure.true_time_s = truth;
    exposure.seed = seed++;
    series.push_back(exposure);
  }
  const Answer answer = Merge(folder, ShootAll(folder, camera, series, wedge.Scene()));
  ExpectAnswered(answer);
  const double step = answer.document["frames"][1]["ratio_ev"].get<double>() -
                      answer.document["frames"][0]["ratio_ev"].get<double>();
  EXPECT_NEAR(step, std::log2(1.067 * 4.0), 0.003);
  const double next = answer.document["frames"][2]["ratio_ev"].get<double>() -
                      answer.document["frames"][1]["ratio_ev"].get<double>();
  EXPECT_NEAR(next, std::log2(4.0 * 0.933 / 1.067), 0.003);
}

TEST(HardCaseP, P09TheSunBesideMoonlightFitsTheFileAndItsHalfFormIsWarned) {
  // lightcal writes floats: 1e-3 and 2e9 cd/m^2 in one file.
  const TempDir folder;
  std::vector<float> samples(64 * 32, 1e-3F);
  samples[100] = 2e9F;
  const std::string sun =
      folder.Write("sun.exr", EncodeExr(64, 32, samples, {FloatOf("whiteLuminance", 1.0F)}));
  const Answer whole = Ask({"inspect", sun});
  ExpectAnswered(whole);
  EXPECT_EQ(whole.document["luminance_nits"]["max"], 2e9);
  EXPECT_NEAR(whole.document["luminance_nits"]["min"].get<double>(), 1e-3, 1e-9);
  // What a half float makes of it is said, and what stops it.
  ExpectWarned(Ask({"exposure", "--aperture", "f/16", "--shutter", "1/64", "--iso", "100",
                    "--light", "2e9nits"}),
               "fp16_overflow");
}

// A room of 1000 to 2000, a lamp of ten times 65504, in the units of the longer of two frames.
Words HalfFrames(const TempDir& folder, double shorter) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Words words;
  for (const double exposure : {shorter, 1.0}) {
    std::vector<float> samples;
    for (int i = 0; i < kWide * kHigh; ++i) {
      const bool lamp = i % kWide >= 40 && i % kWide < 44 && i / kWide == 30;  // of 4 pixels
      const double signal = exposure * (lamp ? 655040.0 : 1000.0 + 1000.0 * (i % kWide) / kWide);
      const double noisy = signal + std::sqrt(signal + 1.0) * normal(random);
      samples.push_back(noisy > 65519.0 ? std::numeric_limits<float>::infinity()
                                        : static_cast<float>(noisy));
    }
    const std::string name = "half_" + std::to_string(words.size()) + ".exr";
    words.push_back(folder.Write(name, EncodeHalfExr(kWide, kHigh, samples)));
  }
  return words;
}

TEST(HardCaseP, P09WhatAHalfFloatCannotHoldIsClippedAndNotInfinite) {
  const TempDir folder;
  // The shorter frame, a thirty-second of the longer one, holds the lamp.
  const Words exposure = {"--exposures", "1/800,1/25", "--f-number", "8", "--iso", "100"};
  const Answer held = Merge(folder, HalfFrames(folder, 1.0 / 32), exposure);
  EXPECT_FALSE(Warns(held, "clipped"));
  EXPECT_FALSE(Warns(held, "bad_samples"));
  Picture lum = ReadExr(folder.path() + "/lum.exr");
  EXPECT_NEAR(lum.Mean(40, 30, 4, 1) / lum.Mean(0, 0, kWide, 20) * 1494.8, 655040.0, 0.02 * 655040);
  // Here it does not: a lower bound with all of itself as its sigma.
  const Words close = {"--exposures", "1/50,1/25", "--f-number", "8", "--iso", "100"};
  const Answer lost = Merge(folder, HalfFrames(folder, 0.5), close);
  ExpectWarned(lost, "clipped");
  EXPECT_NEAR(lost.document["clipped_fraction"].get<double>(), 4.0 / (kWide * kHigh), 1e-6);
  lum = ReadExr(folder.path() + "/lum.exr");
  EXPECT_NEAR(lum.Mean(40, 30, 4, 1) / lum.Mean(0, 0, kWide, 20) * 1494.8, 131008.0, 0.01 * 131008);
  EXPECT_GE(ReadExr(folder.path() + "/sigma.exr").Mean(40, 30, 4, 1),
            0.99 * lum.Mean(40, 30, 4, 1));
  // One picture alone says it too.
  const Answer one = Ask({"inspect", folder.path() + "/half_1.exr"});
  ExpectWarned(one, "clipped");
  EXPECT_EQ(one.document["luminance_nits"]["max"], 65504.0);
}

TEST(HardCaseP, P10TheOrderOfFramesAndDoublesDoNotMatter) {
  const TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  const Words files = ShootAll(folder, camera, Series(3), Wedge(camera).Scene());
  ExpectAnswered(Merge(folder, files));
  const std::vector<float> in_order = ReadExr(folder.path() + "/lum.exr").samples;
  ExpectAnswered(Merge(folder, {files[2], files[0], files[1]}));
  EXPECT_EQ(ReadExr(folder.path() + "/lum.exr").samples, in_order);
  const std::string copy = folder.path() + "/copy.dng";
  std::filesystem::copy_file(files[1], copy);
  ExpectWarned(Merge(folder, {files[0], files[1], copy, files[2]}), "duplicate_frame");
  EXPECT_EQ(ReadExr(folder.path() + "/lum.exr").samples, in_order);
}

TEST(HardCaseP, P11AFrameThatFlickeredIsScaledAndNamed) {
  // The middle frame met the lamp 40 % brighter.
  const TempDir folder;
  const SyntheticCamera camera = Camera();
  const StepWedge wedge = Wedge(camera, 10.0, 1e4);
  std::vector<SyntheticExposure> series = Series(3);
  ExpectAnswered(Merge(folder, ShootAll(folder, camera, series, wedge.Scene())));
  const double steady = ScaleOf(folder, wedge);
  series[1].true_time_s *= 1.4;
  const Answer answer = Merge(folder, ShootAll(folder, camera, series, wedge.Scene()));
  ExpectWarned(answer, "exposure_off");
  EXPECT_NEAR(ScaleOf(folder, wedge) / steady, 1.0, 0.05);
  const Picture sigma = ReadExr(folder.path() + "/sigma.exr");
  EXPECT_GT(sigma.Mean(0, 0, 300, 200), 0.0);
}

TEST(HardCaseP, P12ARegionOutsideThePictureIsRefused) {
  const TempDir folder;
  const std::string picture = folder.Write("a.exr", OddExr(104.0F));
  for (const char* rect :
       {"0,0,0,0", "100,100,5,5", "60,30,50,50", "-5,0,5,5", "2147483647,0,2147483647,1"}) {
    ExpectRefused(Ask({"inspect", picture, std::string("--rect=") + rect}), "bad_region");
  }
}

}  // namespace
}  // namespace lightcal::test::hard
