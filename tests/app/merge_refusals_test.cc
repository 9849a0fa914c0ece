// SPDX-License-Identifier: Apache-2.0
// lightcal merge on brackets that cannot be merged, or not without a warning.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "merge_brackets.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests
using test::StepWedge;
using test::SyntheticCamera;
using test::SyntheticScene;
using test::SyntheticXyz;

TEST(MergeCommand, AllSaturatedIsRefused) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(64, 64);
  const Words files =
      ShootAll(folder, camera, Series(3), [](int, int) { return test::XyzOf(1e7); });
  ExpectRefused(files, folder.path() + "/lum.exr", "all_saturated");
}

TEST(MergeCommand, AllBlackIsRefused) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(64, 64);
  const Words files = ShootAll(folder, camera, Series(3), [](int, int) { return test::XyzOf(0); });
  ExpectRefused(files, folder.path() + "/lum.exr", "all_black");
}

TEST(MergeCommand, OneFrameAnswersWhereItsNoiseIsKnown) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const StepWedge wedge = Wedge(camera, 100.0, 1e4);
  const Words files = ShootAll(folder, camera, Series(1), wedge.Scene());
  const json answer = MergeJson(files, folder.path() + "/lum.exr");
  EXPECT_TRUE(Warns(answer, "one_frame"));
  EXPECT_EQ(answer["noise"]["source"], "noise_profile");
  test::SyntheticDngOptions silent;
  silent.noise_profile = false;
  ExpectRefused({Shoot(folder, "silent", camera, Series(1)[0], wedge.Scene(), silent)},
                folder.path() + "/none.exr", "one_frame");
}

TEST(MergeCommand, WithoutExposureTimeThereIsNoAnswer) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(64, 64);
  auto series = Series(3);
  for (auto& exposure : series) exposure.label_time_s = 0.0;
  const Words files = ShootAll(folder, camera, series, Wedge(camera).Scene());
  ExpectRefused(files, folder.path() + "/lum.exr", "no_exposure_metadata");
  const json answer =
      MergeJson(files, folder.path() + "/lum.exr", {"--exposures", "1/1000,1/250,1/60"});
  EXPECT_NEAR(answer["frames"][2]["ratio_ev"], 4.0, 0.3);
}

TEST(MergeCommand, ExposuresTypedInAnotherOrderAreRefused) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const Words files = ShootAll(folder, camera, Series(3), Wedge(camera).Scene());
  ExpectRefused(files, folder.path() + "/lum.exr", "exposures_disagree",
                {"--exposures", "1/60,1/250,1/1000"});
}

// A lens cap, a flash that did not fire: zeros are no measurement where the labels foretell light.
TEST(MergeCommand, ABlackFrameIsRefusedWhereverItStands) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  const auto series = Series(3);
  const auto lit = [](int, int) { return test::XyzOf(3500.0); };
  const auto black = [](int, int) { return test::XyzOf(0.0); };
  const Words files = ShootAll(folder, camera, series, lit);
  for (std::size_t i = 0; i < files.size(); ++i) {
    Words with = files;
    with[i] = Shoot(folder, "black" + std::to_string(i), camera, series[i], black);
    ExpectRefused(with, folder.path() + "/lum.exr", "exposures_disagree");
  }
}

// The same where the shortest frames are as dark as their labels say.
TEST(MergeCommand, AFrameThatItsLabelSaysIsDarkIsUsed) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  const Words files =
      ShootAll(folder, camera, Series(5), [](int, int) { return test::XyzOf(50.0); });
  const json answer = MergeJson(files, folder.path() + "/lum.exr");
  EXPECT_NEAR(ReadExr(folder.path() + "/lum.exr").Mean(10, 10, 70, 40) / 50.0, 1.0, 0.05);
}

TEST(MergeCommand, TheSamePictureTwiceCountsOnce) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  Words files = ShootAll(folder, camera, Series(3), Wedge(camera).Scene());
  const std::string copy = folder.path() + "/copy.dng";
  std::filesystem::copy_file(files[1], copy);
  const std::string with = folder.path() + "/with.exr", without = folder.path() + "/without.exr";
  static_cast<void>(MergeJson(files, without));
  files.push_back(copy);
  EXPECT_TRUE(Warns(MergeJson(files, with), "duplicate_frame"));
  EXPECT_EQ(ReadExr(with).samples, ReadExr(without).samples);
}

TEST(MergeCommand, FramesOfDifferentSizeAreRefusedAndMixedIsoIsNamed) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  auto series = Series(3);
  Words files = ShootAll(folder, camera, series, Wedge(camera).Scene());
  const SyntheticCamera small = Camera(64, 64);
  ExpectRefused(
      {files[0], files[1], Shoot(folder, "small", small, series[2], Wedge(small).Scene())},
      folder.path() + "/lum.exr", "mixed_size");
  series[2].iso = 200.0;
  files[2] = Shoot(folder, "iso200", camera, series[2], Wedge(camera).Scene());
  EXPECT_TRUE(Warns(MergeJson(files, folder.path() + "/lum.exr"), "mixed_iso"));
}

TEST(MergeCommand, AMovedFocusOrZoomOrApertureIsNamed) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  const auto series = Series(3);
  const auto scene = Wedge(camera).Scene();
  const Words files = ShootAll(folder, camera, series, scene);
  const auto warns = [&](const std::string& code, const test::SyntheticDngOptions& options,
                         double f_number) {
    test::SyntheticExposure other = series[2];
    other.label_f_number = f_number;
    const std::string file = Shoot(folder, "other", camera, other, scene, options);
    return Warns(MergeJson({files[0], files[1], file}, folder.path() + "/lum.exr", {"--force"}),
                 code);
  };
  test::SyntheticDngOptions options;
  options.focal_length_mm = 50.0;
  EXPECT_TRUE(warns("mixed_focus", options, 8.0));
  options.focal_length_mm = 35.0;
  EXPECT_TRUE(warns("mixed_aperture", options, 9.0));
  options.subject_distance_m = 2.0;
  Words focused;
  for (std::size_t i = 0; i < 3; ++i) {
    options.subject_distance_m = i == 2 ? 3.0 : 2.0;
    focused.push_back(
        Shoot(folder, "focus" + std::to_string(i), camera, series[i], scene, options));
  }
  EXPECT_TRUE(Warns(MergeJson(focused, folder.path() + "/lum.exr", {"--force"}), "mixed_focus"));
}

TEST(MergeCommand, ATruncatedFileIsRefused) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  test::SyntheticDngOptions packed;
  packed.lossless_jpeg = true;
  const auto cut = [&](const std::string& path) {
    std::string bytes = test::ReadFile(path);
    bytes.resize(bytes.size() * 3 / 5);
    return folder.Write("cut" + std::filesystem::path(path).extension().string(), bytes);
  };
  for (const auto& options : {test::SyntheticDngOptions{}, packed}) {
    const Words files = ShootAll(folder, camera, Series(2), Wedge(camera).Scene(), options);
    ExpectRefused({files[0], cut(files[1])}, folder.path() + "/lum.exr", "bad_picture");
  }
  for (const char* name :
       {"pictures/exr/Rec709.exr", "pictures/own/ramp_8bit.jpg", "pictures/latlong/lobby.hdr"}) {
    const std::string whole = test::SampleData(name);
    ExpectRefused({whole, cut(whole)}, folder.path() + "/lum.exr", "bad_picture",
                  {"--exposures", "1/60,1/30", "--f-number", "8", "--iso", "100"});
  }
}

TEST(MergeCommand, ACameraThatMovedIsNamed) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const auto series = Series(3);
  const Words files = {Shoot(folder, "a", camera, series[0], Posts(0.0)),
                       Shoot(folder, "b", camera, series[1], Posts(3.0)),
                       Shoot(folder, "c", camera, series[2], Posts(3.0))};
  const json answer = MergeJson(files, folder.path() + "/lum.exr");
  EXPECT_TRUE(Warns(answer, "misaligned")) << answer.dump();
  EXPECT_FALSE(Warns(answer, "moved_content")) << answer.dump();
}

TEST(MergeCommand, APersonWalkingThroughIsNamedAndStrictRefuses) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const auto series = Series(3);
  const auto person = [](int at) {
    return [at](int x, int y) {
      const bool inside = std::abs(x - at) < 15 && y > 80 && y < 180;
      return inside ? test::XyzOf(600.0) : Posts(0.0)(x, y);
    };
  };
  const Words files = {Shoot(folder, "a", camera, series[0], person(60)),
                       Shoot(folder, "b", camera, series[1], person(150)),
                       Shoot(folder, "c", camera, series[2], person(220))};
  const std::string output = folder.path() + "/lum.exr", sigma = folder.path() + "/sigma.exr";
  const json answer = MergeJson(files, output, {"--sigma", sigma});
  EXPECT_TRUE(Warns(answer, "moved_content")) << answer.dump();
  EXPECT_FALSE(Warns(answer, "misaligned")) << answer.dump();
  // The still part keeps its luminance; where the person was, sigma says so.
  const Picture lum = ReadExr(output), sd = ReadExr(sigma);
  EXPECT_GT(sd.Mean(140, 100, 20, 60) / lum.Mean(140, 100, 20, 60), 0.05);
  EXPECT_LT(sd.Mean(20, 10, 100, 40) / lum.Mean(20, 10, 100, 40), 0.02);
  const test::CliResult strict =
      test::RunLightcal(MergeWords(files, folder.path() + "/strict.exr", {"--strict"}));
  EXPECT_EQ(strict.exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/strict.exr"));
}

TEST(MergeCommand, APulsedLampUnderARollingShutterIsNamed) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const auto series = Series(3);
  const SyntheticScene bands = [](int x, int y) {
    const SyntheticXyz c = Posts(0.0)(x, y);
    const double share = 1.0 + 0.2 * std::sin(0.2 * y);
    return SyntheticXyz{c.X * share, c.Y * share, c.Z * share};
  };
  const Words files = {Shoot(folder, "a", camera, series[0], bands),
                       Shoot(folder, "b", camera, series[1], Posts(0.0)),
                       Shoot(folder, "c", camera, series[2], Posts(0.0))};
  const json answer = MergeJson(files, folder.path() + "/lum.exr");
  EXPECT_TRUE(Warns(answer, "flicker")) << answer.dump();
}

TEST(MergeCommand, AStillSceneIsNotAccused) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const json answer =
      MergeJson(ShootAll(folder, camera, Series(4), Posts(0.0)), folder.path() + "/lum.exr");
  for (const char* code : {"misaligned", "moved_content", "flicker", "exposure_off", "clipped"}) {
    EXPECT_FALSE(Warns(answer, code)) << answer.dump();
  }
}

TEST(MergeCommand, AClippedLampIsSaidToBeALowerBound) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const auto scene = [](int x, int y) {
    return x > 250 && y > 150 ? test::XyzOf(1e6) : Posts(0.0)(x, y);
  };
  const std::string output = folder.path() + "/lum.exr", sigma = folder.path() + "/sigma.exr";
  const json answer =
      MergeJson(ShootAll(folder, camera, Series(3), scene), output, {"--sigma", sigma});
  EXPECT_TRUE(Warns(answer, "clipped"));
  EXPECT_NEAR(answer["clipped_fraction"], 49.0 * 49.0 / (300.0 * 200.0), 0.002);
  const Picture lum = ReadExr(output), sd = ReadExr(sigma);
  EXPECT_GT(sd.Mean(260, 160, 30, 30), 0.5 * lum.Mean(260, 160, 30, 30));
  ExpectRefused(ShootAll(folder, camera, Series(3), scene), folder.path() + "/none.exr",
                "bad_anchor", {"--anchor", "260,160,20,20=1000"});
}

TEST(MergeCommand, MalformedOptionsAreWrongUsage) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(64, 64);
  const Words files = ShootAll(folder, camera, Series(2), Wedge(camera).Scene());
  const std::string output = folder.path() + "/lum.exr";
  for (const Words& more : std::vector<Words>{{"--anchor", "1,2,3=5"},
                                              {"--anchor", "1,2,3,4"},
                                              {"--anchor", "1,2,3,4=5lx"},
                                              {"--space", "cmyk"},
                                              {"--white", "3200K"},
                                              {"--noise", "1"},
                                              {"--anchor", "1,2,3,4=5", "--anchor-sigma", "0"}}) {
    const test::CliResult run = test::RunLightcal(MergeWords(files, output, more));
    EXPECT_EQ(run.exit_code, 2) << more[1] << run.err;
  }
  ExpectRefused(files, output, "bad_anchor", {"--anchor", "60,60,20,20=100"});
}

}  // namespace
}  // namespace lightcal
