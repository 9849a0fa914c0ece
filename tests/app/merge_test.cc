// SPDX-License-Identifier: Apache-2.0
// lightcal merge, driven as a shell would, on brackets of known luminance and on bad ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal_devices/captures/picture.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "synthetic_dng.h"

namespace lightcal {
namespace {

using nlohmann::json;
using test::StepWedge;
using test::SyntheticCamera;
using test::SyntheticExposure;
using test::SyntheticScene;
using test::SyntheticXyz;
using Words = std::vector<std::string>;

SyntheticCamera Camera(int width = 300, int height = 200) {
  SyntheticCamera camera;
  camera.width = width;
  camera.height = height;
  camera.prnu_relative = 0.005;
  camera.knee_relative = 0.01;
  camera.row_noise_e = 0.5;
  return camera;
}

// One frame as a file. What lies beyond three times saturation is as bright as that.
std::string Shoot(const test::TempDir& folder, const std::string& stem,
                  const SyntheticCamera& camera, const SyntheticExposure& exposure,
                  const SyntheticScene& scene, const test::SyntheticDngOptions& options = {}) {
  const double most = 3.0 * SaturatingNits(camera, exposure);
  const SyntheticScene reachable = [&scene, most](int x, int y) {
    const SyntheticXyz c = scene(x, y);
    const double share = c.Y > most ? most / c.Y : 1.0;
    return SyntheticXyz{c.X * share, c.Y * share, c.Z * share};
  };
  return test::WriteDngBracket(folder.path(), stem, camera, {exposure}, reachable, options).at(0);
}

Words ShootAll(const test::TempDir& folder, const SyntheticCamera& camera,
               const std::vector<SyntheticExposure>& series, const SyntheticScene& scene,
               const test::SyntheticDngOptions& options = {}) {
  Words files;
  for (const SyntheticExposure& exposure : series) {
    files.push_back(
        Shoot(folder, "f" + std::to_string(files.size()), camera, exposure, scene, options));
  }
  return files;
}

// Something to look at: steps of 8 patches.
StepWedge Wedge(const SyntheticCamera& camera, double lowest = 1.0, double highest = 1e4) {
  return {test::LogSteps(lowest, highest, 8), 4, camera.width, camera.height};
}

std::vector<SyntheticExposure> Series(int frames = 4, std::uint64_t seed = 3) {
  return test::ExposureSeries(1.0 / 1024, frames, 2.0, 8.0, 0.03, seed);
}

struct Picture {
  int width = 0, height = 0, channels = 0;
  std::vector<float> samples;
  [[nodiscard]] double Mean(int x, int y, int w, int h, int channel = 0) const {
    double sum = 0.0;
    for (int j = y; j < y + h; ++j) {
      for (int i = x; i < x + w; ++i) {
        sum += samples[static_cast<std::size_t>((j * width + i) * channels + channel)];
      }
    }
    return sum / w / h;
  }
};

Picture ReadExr(const std::string& path) {
  const auto frame = ReadPicture(path);
  EXPECT_TRUE(frame.has_value()) << path;
  Picture picture;
  if (!frame) return picture;
  const auto& view = std::get<View2d<const float>>(frame->samples);
  picture = {view.width(), view.height(), view.channels(), {}};
  for (int y = 0; y < view.height(); ++y) {
    picture.samples.insert(picture.samples.end(), view.row(y).begin(), view.row(y).end());
  }
  return picture;
}

Words MergeWords(Words files, const std::string& output, const Words& more = {}) {
  files.insert(files.begin(), "merge");
  files.insert(files.end(), {"-o", output});
  files.insert(files.end(), more.begin(), more.end());
  return files;
}

json MergeJson(const Words& files, const std::string& output, Words more = {}) {
  more.emplace_back("--json");
  const test::CliResult run = test::RunLightcal(MergeWords(files, output, more));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

// Exit 3 with this code, and no file.
void ExpectRefused(const Words& files, const std::string& output, const std::string& code,
                   Words more = {}) {
  more.emplace_back("--json");
  const test::CliResult run = test::RunLightcal(MergeWords(files, output, more));
  EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
  EXPECT_EQ(json::parse(run.out)["error"]["code"], code) << run.out;
  EXPECT_FALSE(std::filesystem::exists(output));
}

bool Warns(const json& document, const std::string& code) {
  const json warnings = document.value("warnings", json::array());
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const json& warning) { return warning["code"] == code; });
}

// The middle of a patch of the wedge.
double PatchMean(const Picture& picture, const StepWedge& wedge, int patch) {
  const int w = wedge.width / wedge.columns;
  const int h = wedge.height / 2;
  return picture.Mean(patch % wedge.columns * w + 6, patch / wedge.columns * h + 6, w - 12, h - 12);
}

TEST(MergeCommand, OneSpotReadingGivesEveryLuminance) {
  const test::TempDir folder;
  SyntheticCamera camera = Camera();
  camera.sensitivity = 0.8;  // what the ISO does not say and the reading has to find
  const StepWedge wedge = Wedge(camera, 10.0, 1e4);
  const Words files = ShootAll(folder, camera, Series(), wedge.Scene());
  const std::string output = folder.path() + "/lum.exr";
  // Patch 3 spans x 225-299, y 0-99.
  const json answer = MergeJson(
      files, output,
      {"--anchor", "230,10,60,80=" + std::to_string(wedge.nits[3]), "--anchor-sigma", "1%"});
  const Picture picture = ReadExr(output);
  ASSERT_EQ(picture.width, camera.width);
  for (int patch = 0; patch < 8; ++patch) {
    const double nits = wedge.nits[static_cast<std::size_t>(patch)];
    EXPECT_NEAR(PatchMean(picture, wedge, patch) / nits, 1.0, 0.003) << nits;
  }
  EXPECT_EQ(answer["scale"]["source"], "anchor");
  // The reading's own 1 % and less than 1 % more.
  EXPECT_GE(answer["scale"]["u95_relative"], 1.95 * 0.01);
  EXPECT_LT(answer["scale"]["u95_relative"], 2.2 * 0.01);
  EXPECT_EQ(answer["clipped_fraction"], 0.0);
}

TEST(MergeCommand, TheIsoPriorHoldsTheTruthInItsInterval) {
  for (const double sensitivity : {0.8, 1.0, 1.25}) {
    const test::TempDir folder;
    SyntheticCamera camera = Camera();
    camera.sensitivity = sensitivity;
    const StepWedge wedge = Wedge(camera);
    const std::string output = folder.path() + "/lum.exr";
    const json answer = MergeJson(ShootAll(folder, camera, Series(), wedge.Scene()), output);
    EXPECT_EQ(answer["scale"]["source"], "iso_prior");
    const double u95 = answer["scale"]["u95_relative"];
    EXPECT_LT(u95, 0.5);
    const double off = PatchMean(ReadExr(output), wedge, 4) / wedge.nits[4];
    EXPECT_NEAR(off, sensitivity, 0.05);  // what the ISO says, to the labels' error
    EXPECT_LT(std::abs(off - 1.0), u95);
  }
}

TEST(MergeCommand, JsonHasTheKeysOfTheContract) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const json answer = MergeJson(ShootAll(folder, camera, Series(3), Wedge(camera).Scene()),
                                folder.path() + "/lum.exr");
  ASSERT_EQ(answer["frames"].size(), 3U);
  for (const json& frame : answer["frames"]) {
    for (const char* key : {"file", "exposure_s", "f_number", "iso", "ratio_ev", "used"}) {
      EXPECT_TRUE(frame.contains(key)) << key;
    }
  }
  EXPECT_NEAR(answer["frames"][2]["ratio_ev"], 4.0, 0.2);
  EXPECT_EQ(answer["frames"][0]["f_number"], 8.0);
  EXPECT_TRUE(answer["scale"].contains("nits_per_unit"));
  EXPECT_TRUE(answer.contains("clipped_fraction"));
}

TEST(MergeCommand, SigmaIsTheScatterOfEqualPixels) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const StepWedge wedge = Wedge(camera);
  const std::string output = folder.path() + "/lum.exr", sigma = folder.path() + "/sigma.exr";
  static_cast<void>(
      MergeJson(ShootAll(folder, camera, Series(), wedge.Scene()), output, {"--sigma", sigma}));
  const Picture lum = ReadExr(output), sd = ReadExr(sigma);
  for (const int patch : {0, 2, 5, 7}) {
    const int x0 = patch % 4 * 75 + 6, y0 = patch / 4 * 100 + 6;
    const double mean = lum.Mean(x0, y0, 63, 88);
    double scatter = 0.0, claimed = 0.0;
    for (int y = y0; y < y0 + 88; ++y) {
      for (int x = x0; x < x0 + 63; ++x) {
        const auto i = static_cast<std::size_t>(y * lum.width + x);
        scatter += std::pow(lum.samples[i] - mean, 2);
        claimed += std::pow(sd.samples[i], 2);
      }
    }
    EXPECT_NEAR(std::sqrt(claimed / scatter), 1.0, 0.08) << patch;
  }
}

TEST(MergeCommand, ANeutralUnderItsOwnWhiteIsWhiteInEverySpace) {
  const test::TempDir folder;
  SyntheticCamera camera = Camera(64, 64);
  camera.prnu_relative = camera.row_noise_e = camera.knee_relative = 0.0;
  camera.full_well_e = 1e9;   // no noise to speak of: what is asked is a matrix
  camera.read_noise_e = 1e5;  // 1.5 DN, so that rounding leaves no bias
  const Xy warm = XyFromCct(Kelvin(3200));
  const StepWedge wedge{{400.0, 40.0}, 2, 64, 64, warm.x, warm.y};
  test::SyntheticDngOptions options;
  options.white_x = warm.x;
  options.white_y = warm.y;
  const Words files = ShootAll(folder, camera, Series(3), wedge.Scene(), options);
  for (const std::string space : {"rec709", "acescg", "rec2020", "p3"}) {
    const std::string output = folder.path() + "/" + space + ".exr";
    static_cast<void>(MergeJson(
        files, output, {"--space", space, "--white", "3200K", "--anchor", "4,4,24,56=400"}));
    const Picture rgb = ReadExr(output);
    ASSERT_EQ(rgb.channels, 3);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(rgb.Mean(4, 4, 24, 56, c) / 400.0, 1.0, 2e-4) << space << " channel " << c;
    }
  }
}

TEST(MergeCommand, FramesMayComeInAnyOrder) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera(96, 64);
  Words files = ShootAll(folder, camera, Series(4), Wedge(camera).Scene());
  const std::string first = folder.path() + "/a.exr", second = folder.path() + "/b.exr";
  static_cast<void>(MergeJson(files, first));
  std::rotate(files.begin(), files.begin() + 2, files.end());
  static_cast<void>(MergeJson(files, second));
  EXPECT_EQ(ReadExr(first).samples, ReadExr(second).samples);
}

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

TEST(MergeCommand, APictureWithANanIsRefused) {
  const test::TempDir folder;
  // OpenEXR written by hand: uncompressed scanlines of one float channel, one NaN among them.
  const auto exr = [](float odd) {
    std::string bytes;
    const auto put = [&](const auto& value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    const auto attribute = [&](const std::string& name, const std::string& type,
                               const std::string& value) {
      bytes += name + '\0' + type + '\0';
      put(static_cast<std::int32_t>(value.size()));
      bytes += value;
    };
    const auto raw = [](auto... values) {
      std::string text;
      (text.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
      return text;
    };
    put(std::int32_t{20000630});
    put(std::int32_t{2});
    attribute("channels", "chlist",
              std::string("Y\0", 2) +
                  raw(std::int32_t{2}, std::int32_t{0}, std::int32_t{1}, std::int32_t{1}) +
                  std::string(1, '\0'));
    attribute("compression", "compression", std::string(1, '\0'));
    const std::string window =
        raw(std::int32_t{0}, std::int32_t{0}, std::int32_t{15}, std::int32_t{15});
    attribute("dataWindow", "box2i", window);
    attribute("displayWindow", "box2i", window);
    attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    attribute("pixelAspectRatio", "float", raw(1.0F));
    attribute("screenWindowCenter", "v2f", raw(0.0F, 0.0F));
    attribute("screenWindowWidth", "float", raw(1.0F));
    bytes += '\0';
    const std::size_t table = bytes.size();
    for (int y = 0; y < 16; ++y) put(static_cast<std::uint64_t>(table + 16 * 8 + y * (8 + 64)));
    for (int y = 0; y < 16; ++y) {
      put(std::int32_t{y});
      put(std::int32_t{64});
      for (int x = 0; x < 16; ++x) put(x == 3 && y == 3 ? odd : 0.01F * static_cast<float>(x + y));
    }
    return bytes;
  };
  const Words good = {folder.Write("a.exr", exr(0.5F)), folder.Write("b.exr", exr(0.6F))};
  const Words exposures = {"--exposures", "1/60,1/30", "--f-number", "8", "--iso", "100"};
  const Words bad = {good[0],
                     folder.Write("nan.exr", exr(std::numeric_limits<float>::quiet_NaN()))};
  ExpectRefused(bad, folder.path() + "/lum.exr", "bad_samples", exposures);
}

// A bright wall with dark posts, so that movement shows anywhere.
SyntheticScene Posts(double shift) {
  return [shift](int x, int y) {
    const double pattern = std::sin(0.13 * (x - shift)) * std::sin(0.11 * y + 0.02 * (x - shift));
    return test::XyzOf(3000.0 + 2500.0 * pattern);
  };
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

// Ranks of two lists agree: Spearman's coefficient.
double Spearman(const std::vector<double>& a, const std::vector<double>& b) {
  const auto ranks = [](const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
    std::vector<double> rank(values.size());
    for (std::size_t i = 0; i < order.size();) {
      std::size_t end = i;
      while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
      for (std::size_t k = i; k < end; ++k) rank[order[k]] = 0.5 * static_cast<double>(i + end - 1);
      i = end;
    }
    return rank;
  };
  const auto ra = ranks(a), rb = ranks(b);
  const double mean = 0.5 * static_cast<double>(a.size() - 1);
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < ra.size(); ++i) {
    ab += (ra[i] - mean) * (rb[i] - mean);
    aa += (ra[i] - mean) * (ra[i] - mean);
    bb += (rb[i] - mean) * (rb[i] - mean);
  }
  return ab / std::sqrt(aa * bb);
}

// Three PNGs of a Nikon D40; GEGL's own merge of them is the reference.
TEST(MergeCommand, ARealPngBracketRanksItsPixelsAsGeglDoes) {
  const test::TempDir folder;
  const std::string place = "pictures/png_bracket/";
  const Words files = {test::SampleData(place + "parliament_0.png"),
                       test::SampleData(place + "parliament_1.png"),
                       test::SampleData(place + "parliament_2.png")};
  const std::string output = folder.path() + "/rgb.exr";
  static_cast<void>(MergeJson(
      files, output,
      {"--exposures", "1/50,1/13,0.4", "--f-number", "8", "--iso", "800", "--space", "rec709"}));
  const Picture rgb = ReadExr(output);
  const Picture reference = ReadExr(test::SampleData(place + "parliament.hdr"));
  ASSERT_EQ(rgb.samples.size(), reference.samples.size());
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> ours, theirs;
    for (std::size_t i = c; i < rgb.samples.size(); i += 3) {
      ours.push_back(rgb.samples[i]);
      theirs.push_back(reference.samples[i]);
    }
    EXPECT_GT(Spearman(ours, theirs), 0.97) << "channel " << c;
  }
}

}  // namespace
}  // namespace lightcal
