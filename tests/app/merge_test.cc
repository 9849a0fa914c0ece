// SPDX-License-Identifier: Apache-2.0
// lightcal merge, driven as a shell would, on brackets of known luminance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "merge_brackets.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests
using test::StepWedge;
using test::SyntheticCamera;
using test::SyntheticScene;
using test::SyntheticXyz;

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

// What the ISO speed promises is right within a factor of 3; a reading typed in another unit is
// not.
TEST(MergeCommand, AnAnchorFarFromTheIsoSpeedIsNamedWithTheUnitThatFits) {
  const test::TempDir folder;
  const SyntheticCamera camera = Camera();
  const StepWedge wedge = Wedge(camera, 10.0, 1e4);
  const Words files = ShootAll(folder, camera, Series(), wedge.Scene());
  const auto codes = [&](double factor, const std::string& says) {
    const json answer = MergeJson(
        files, folder.path() + "/lum.exr",
        {"--anchor", "230,10,60,80=" + std::to_string(factor * wedge.nits[3]), "--force"});
    std::string found;
    for (const json& warning : answer.value("warnings", json::array())) {
      if (warning["code"] != "prior_conflict") continue;
      found = warning["message"];
    }
    EXPECT_EQ(found.empty(), says.empty()) << factor << ": " << found;
    EXPECT_NE(found.find(says), std::string::npos) << found;
  };
  codes(1.0, "");
  codes(1.7, "");
  codes(3.426, "foot-lamberts");
  codes(1e-3, "kcd/m2");
  codes(1e4, "cd/cm2");
  codes(50.0, "ND filter");
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

TEST(MergeCommand, AnXTransMosaicMergesAsABayerOneDoes) {
  const test::TempDir folder;
  SyntheticCamera camera = Camera();
  camera.x_trans = true;
  const StepWedge wedge = Wedge(camera, 10.0, 1e4);
  const std::string output = folder.path() + "/lum.exr", sigma = folder.path() + "/sigma.exr";
  const json answer =
      MergeJson(ShootAll(folder, camera, Series(), wedge.Scene()), output,
                {"--sigma", sigma, "--anchor", "230,10,60,80=" + std::to_string(wedge.nits[3])});
  EXPECT_FALSE(Warns(answer, "moved_content")) << answer.dump();
  const Picture picture = ReadExr(output), sd = ReadExr(sigma);
  for (int patch = 0; patch < 8; ++patch) {
    const double nits = wedge.nits[static_cast<std::size_t>(patch)];
    EXPECT_NEAR(PatchMean(picture, wedge, patch) / nits, 1.0, 0.003) << nits;
    EXPECT_LT(PatchMean(sd, wedge, patch) / nits, 0.2) << nits;
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
  const json answer = MergeJson(
      files, output,
      {"--exposures", "1/50,1/13,0.4", "--f-number", "8", "--iso", "800", "--space", "rec709"});
  // Nothing moved between them; the curve, 8 bits and the camera's own toning differ everywhere.
  for (const char* code : {"misaligned", "moved_content", "flicker"}) {
    EXPECT_FALSE(Warns(answer, code)) << answer.dump();
  }
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
