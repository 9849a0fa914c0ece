// SPDX-License-Identifier: Apache-2.0
// lightcal merge and inspect: what white balance, spaces and adaptation may and may not move.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "merge_brackets.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests
using test::StepWedge;
using test::SyntheticCamera;

// No noise to speak of: what is asked is a matrix.
SyntheticCamera QuietCamera() {
  SyntheticCamera camera = Camera(160, 128);
  camera.prnu_relative = camera.row_noise_e = camera.knee_relative = 0.0;
  camera.full_well_e = 1e9;
  camera.read_noise_e = 1e5;  // 1.5 DN, so that rounding leaves no bias
  return camera;
}

struct Space {
  const char* name;
  std::array<double, 3> luminance;  // of its primaries
};
// Sources: ITU-R BT.709-6 and BT.2020-2 (primaries and D65), S-2014-004 (AP1), to seven digits.
constexpr std::array kSpaces = {Space{"rec709", {0.2126390, 0.7151687, 0.0721923}},
                                Space{"acescg", {0.2722287, 0.6740818, 0.0536895}},
                                Space{"rec2020", {0.2627002, 0.6779981, 0.0593017}}};
// Black body of 3200 K, from Planck's law with c2 = 1.4388e-2 and the CIE 1931 observer.
constexpr double kWarmX = 0.4233629, kWarmY = 0.3989530;

TEST(MergeColor, WhiteBalanceMovesNeitherLuminanceNorColour) {
  const test::TempDir folder;
  SyntheticCamera camera = QuietCamera();
  const StepWedge wedge{{400.0, 4000.0}, 2, camera.width, camera.height, kWarmX, kWarmY};
  const auto exposure = Series(1)[0];
  const auto picture = Expose(camera, exposure, wedge.Scene());
  std::vector<Picture> merged;
  std::vector<double> inspected;
  for (const auto& [x, y] : {std::pair{kWarmX, kWarmY}, std::pair{0.29903, 0.31488}}) {  // D75
    test::SyntheticDngOptions options;
    options.warm_matrix = true;
    options.white_x = x;
    options.white_y = y;
    const std::string name = "balanced_" + std::to_string(merged.size());
    const std::string file =
        folder.Write(name + ".dng", EncodeDng(camera, exposure, picture, options));
    const std::string output = folder.path() + "/" + name + ".exr";
    static_cast<void>(MergeJson({file}, output, {"--space", "acescg"}));
    merged.push_back(ReadExr(output));
    inspected.push_back(
        test::LightcalJson("inspect", {file})["luminance_nits"]["mean"].get<double>());
  }
  EXPECT_EQ(merged[0].samples, merged[1].samples);
  EXPECT_EQ(inspected[0], inspected[1]);
}

// ISO speed promises luminance in daylight; another white balance must not break that promise.
TEST(MergeColor, DaylightReadsByIsoWhateverTheWhiteBalance) {
  const test::TempDir folder;
  const SyntheticCamera camera = QuietCamera();
  test::SyntheticDngOptions options;
  options.white_x = kWarmX;
  options.white_y = kWarmY;
  test::SyntheticExposure exposure;
  exposure.true_time_s = exposure.label_time_s = 1.0 / 64;
  const std::string file = Shoot(
      folder, "day", camera, exposure, [](int, int) { return test::XyzOf(1000.0); }, options);
  const json got = test::LightcalJson("inspect", {file});
  EXPECT_NEAR(got["luminance_nits"]["mean"].get<double>() / 1000.0, 1.0, 5e-4);
  EXPECT_NEAR(got["as_shot"]["xy"][0].get<double>(), kWarmX, 1e-4);
  EXPECT_NEAR(got["as_shot"]["cct_K"].get<double>(), 3200.0, 3.0);
}

TEST(MergeColor, ANeutralUnderItsOwnWhiteIsWhiteInEverySpace) {
  const test::TempDir folder;
  const SyntheticCamera camera = QuietCamera();
  const StepWedge wedge{{3000.0, 300.0}, 2, camera.width, camera.height, kWarmX, kWarmY};
  test::SyntheticDngOptions options;
  options.white_x = kWarmX;
  options.white_y = kWarmY;
  const Words files = ShootAll(folder, camera, Series(3), wedge.Scene(), options);
  for (const std::string space : {"rec709", "acescg", "rec2020", "p3"}) {
    const std::string output = folder.path() + "/" + space + ".exr";
    static_cast<void>(MergeJson(
        files, output, {"--space", space, "--white", "3200K", "--anchor", "4,4,72,120=3000"}));
    const Picture rgb = ReadExr(output);
    ASSERT_EQ(rgb.channels, 3);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(rgb.Mean(4, 4, 72, 120, c) / 3000.0, 1.0, 1e-4) << space << " channel " << c;
    }
  }
}

// Deep blue, red and green: what an adaptation moves most.
TEST(MergeColor, ASaturatedLedKeepsItsLuminance) {
  const test::TempDir folder;
  const SyntheticCamera camera = QuietCamera();
  const std::array<std::pair<double, double>, 4> lamps = {
      {{0.31272, 0.32903}, {0.14, 0.05}, {0.69, 0.30}, {0.20, 0.70}}};
  const auto scene = [&](int x, int) {
    const auto& [lamp_x, lamp_y] = lamps[static_cast<std::size_t>(x / 40)];
    return test::XyzOf(1000.0, lamp_x, lamp_y);
  };
  const Words files = ShootAll(folder, camera, Series(3), scene);
  const Words anchor = {"--anchor", "4,4,32,120=1000"};
  const std::string plain = folder.path() + "/plain.exr";
  static_cast<void>(MergeJson(files, plain, anchor));
  const Picture luminance = ReadExr(plain);
  for (const Space& space : kSpaces) {
    for (const bool adapted : {false, true}) {
      Words more = anchor;
      more.insert(more.end(), {"--space", space.name});
      if (adapted) more.insert(more.end(), {"--white", "3200K"});
      const std::string output = folder.path() + "/rgb.exr";
      static_cast<void>(MergeJson(files, output, more));
      const Picture rgb = ReadExr(output);
      for (int lamp = 0; lamp < 4; ++lamp) {
        double nits = 0.0;
        for (int c = 0; c < 3; ++c) {
          nits +=
              space.luminance[static_cast<std::size_t>(c)] * rgb.Mean(40 * lamp + 4, 4, 32, 120, c);
        }
        EXPECT_NEAR(nits, 1000.0, 1.0) << space.name << " lamp " << lamp << adapted;
        EXPECT_NEAR(nits / luminance.Mean(40 * lamp + 4, 4, 32, 120), 1.0, 1e-5)
            << space.name << " lamp " << lamp << adapted;
      }
    }
  }
}

// A Radiance file of 64 x 32: a red ramp above a green one.
std::string RadianceRamps(const std::string& header) {
  std::string bytes = "#?RADIANCE\n" + header + "FORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto code = static_cast<char>(128 + x);
      bytes += y < 16 ? std::string{code, 0, 0, 0} : std::string{0, code, 0, 0};
      bytes.back() = static_cast<char>(126);  // 2^-2 of 256ths
    }
  }
  return bytes;
}

// One rule for both commands: Rec. 709 where the file is silent, and that is said.
TEST(MergeColor, ARadianceFileMeansTheSamePrimariesToMergeAndInspect) {
  const test::TempDir folder;
  for (const bool named : {false, true}) {
    const std::string file = folder.Write(
        "ramps.hdr", RadianceRamps(named ? "PRIMARIES=.640 .330 .290 .600 .150 .060 .3333333 "
                                           ".3333333\n"
                                         : ""));
    // Mantissas 133 ... 182 in one channel and 0 in the others, half a step more in all three.
    const double red = named ? 0.265106 : 0.2126390, green = named ? 0.670106 : 0.7151687;
    const double expected =
        (158.0 * red + 0.5 * (1.0 - red)) / (158.0 * green + 0.5 * (1.0 - green));
    const std::string output = folder.path() + "/lum.exr";
    const json merged = MergeJson({file}, output,
                                  {"--exposures", "1/60", "--f-number", "8", "--iso", "100",
                                   "--noise", "1e-5,1e-8", "--force"});
    const Picture lum = ReadExr(output);
    EXPECT_NEAR(lum.Mean(5, 2, 50, 10) / lum.Mean(5, 20, 50, 10) / expected, 1.0, 1e-4);
    const auto mean = [&](const char* rect) {
      const json got = test::LightcalJson("inspect", {file, "--rect", rect});
      EXPECT_EQ(Warns(got, "primaries_assumed"), !named);
      return got["luminance_nits"]["mean"].get<double>();
    };
    EXPECT_NEAR(mean("5,2,50,10") / mean("5,20,50,10") / expected, 1.0, 1e-4);
    EXPECT_EQ(Warns(merged, "primaries_assumed"), !named);
  }
}

}  // namespace
}  // namespace lightcal
