// SPDX-License-Identifier: Apache-2.0
// lightcal inspect --glare against evalglare 2.10's own answers, and by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kVectors = "vectors/glare/";

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

// file -> column -> what evalglare said.
std::map<std::string, std::map<std::string, double>> Evalglare() {
  std::istringstream in(ReadFile(SampleData(kVectors + "glare.csv")));
  std::string line;
  std::getline(in, line);
  const auto header = Cells(line);
  std::map<std::string, std::map<std::string, double>> all;
  while (std::getline(in, line)) {
    const auto cells = Cells(line);
    for (std::size_t i = 1; i < cells.size(); ++i) all[cells[0]][header[i]] = std::stod(cells[i]);
  }
  return all;
}

json GlareOf(const std::string& path, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {path, "--glare", "--projection", "equidistant", "--fov", "180"};
  words.insert(words.end(), more.begin(), more.end());
  return LightcalJson("inspect", words)["glare"];
}

class GlarePicture : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Evalglare210, GlarePicture,
                         testing::Values("lobby_0_0", "lobby_120_0", "lobby_60_10", "studio_0_0",
                                         "studio_120_0", "studio_60_10", "sunset_0_0",
                                         "sunset_120_0", "sunset_60_10"),
                         [](const auto& parameter) { return std::string(parameter.param); });

// evalglare takes a source's centre at the pixel above its own, which moves UGR by up to .1.
TEST_P(GlarePicture, SaysWhatEvalglareSaid) {
  const std::string file = std::string(GetParam()) + ".hdr";
  const auto truth = Evalglare().at(file);
  const json glare = GlareOf(SampleData(kVectors + file));
  const auto number = [&](const char* key) { return glare[key].get<double>(); };
  const auto value = [&](const char* key) { return glare[key]["value"].get<double>(); };
  EXPECT_NEAR(number("ev_lx") / truth.at("E_v"), 1.0, 1e-3);
  EXPECT_NEAR(number("ev_direct_lx") / truth.at("E_v_dir"), 1.0, 1e-3);
  EXPECT_NEAR(number("mean_nits") / truth.at("av_lum"), 1.0, 5e-3);
  EXPECT_NEAR(number("background_nits") / truth.at("lum_backg"), 1.0, 1e-3);
  EXPECT_NEAR(number("sources_solid_angle_sr") / truth.at("omega_sources"), 1.0, 0.01);
  EXPECT_NEAR(number("sources_luminance_nits") / truth.at("lum_sources"), 1.0, 0.01);
  EXPECT_NEAR(value("dgp"), truth.at("dgp"), 0.005);
  EXPECT_NEAR(value("ugr"), truth.at("ugr"), 0.1);
  EXPECT_NEAR(value("dgi"), truth.at("dgi"), 0.1);
  EXPECT_NEAR(value("cgi"), truth.at("cgi"), 0.1);
}

// The scale is off by what the interval allows: the answer of the true scale lies inside.
TEST_P(GlarePicture, IntervalsHoldWhatTheTrueScaleSays) {
  const std::string file = SampleData(kVectors + GetParam() + ".hdr");
  const std::string bytes = ReadFile(file);
  const TempDir dir;
  const json said = GlareOf(file, {"--scale-u95", "20%"});
  for (const char* exposure : {"0.84", "0.93", "1.11", "1.24"}) {
    std::string other = bytes;
    other.insert(other.find('\n') + 1, std::string("EXPOSURE=") + exposure + "\n");
    const json truth = GlareOf(dir.Write("other.hdr", other));
    for (const char* key : {"dgp", "ugr", "dgi", "cgi"}) {
      EXPECT_GT(truth[key]["value"], said[key]["low95"].get<double>() - 0.02) << key << exposure;
      EXPECT_LT(truth[key]["value"], said[key]["high95"].get<double>() + 0.02) << key << exposure;
    }
  }
}

// A disk of `half_deg` and `nits` ahead of the eye, in a view of 100 cd/m^2.
std::string DiskPicture(const TempDir& dir, double half_deg, float nits, int size) {
  std::vector<float> samples(static_cast<std::size_t>(size) * size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double r = std::hypot(x + 0.5 - size / 2.0, y + 0.5 - size / 2.0) / (size / 2.0) * 90.0;
      samples[static_cast<std::size_t>(y) * size + x] = r < half_deg ? nits : 100.0F;
    }
  }
  devices::ExrPicture picture;
  picture.samples = View2d<const float>(samples.data(), size, size);
  picture.channel_names = {"Y"};
  picture.white_luminance = Nits(1.0);
  const std::string path = dir.path() + "/disk.exr";
  EXPECT_TRUE(devices::WriteExr(path, picture));
  return path;
}

// E_v = pi (100 cos^2 a + L sin^2 a), w = 2 pi (1 - cos a), P = 1 ahead.
TEST(GlareCommand, ADiskAheadIsTheClosedForm) {
  const TempDir dir;
  constexpr double kHalf = 6.0, kNits = 8000.0, pi = std::numbers::pi;
  const double a = kHalf * pi / 180.0;
  const json glare = GlareOf(DiskPicture(dir, kHalf, kNits, 900), {"--scale-u95", "1%"});
  const double direct = pi * kNits * std::pow(std::sin(a), 2);
  const double ev = direct + pi * 100.0 * std::pow(std::cos(a), 2);
  const double w = 2.0 * pi * (1.0 - std::cos(a));
  EXPECT_NEAR(glare["ev_lx"].get<double>() / ev, 1.0, 2e-3);
  ASSERT_EQ(glare["sources"].size(), 1U);
  const json& source = glare["sources"][0];
  EXPECT_NEAR(source["luminance_nits"].get<double>(), kNits, 1e-3);
  EXPECT_NEAR(source["solid_angle_sr"].get<double>() / w, 1.0, 3e-3);
  EXPECT_NEAR(source["elevation_deg"].get<double>(), 0.0, 0.01);
  EXPECT_NEAR(source["position_index"].get<double>(), 1.0, 1e-3);
  const double background = (ev - direct) / pi;
  EXPECT_NEAR(glare["ugr"]["value"].get<double>(),
              8.0 * std::log10(0.25 / background * kNits * kNits * w), 0.02);
  // All luminances 1 % higher: UGR by 8 log10(1.01).
  EXPECT_NEAR(glare["ugr"]["high95"].get<double>() - glare["ugr"]["value"].get<double>(),
              8.0 * std::log10(1.01), 1e-3);
  EXPECT_EQ(glare["scale_u95_source"], "stated");
}

TEST(GlareCommand, OptionsOfEvalglareMeanTheSame) {
  const TempDir dir;
  const std::string disk = DiskPicture(dir, 6.0, 8000.0F, 300);
  EXPECT_EQ(GlareOf(disk, {"-b", "9000"})["sources"].size(), 0U);
  EXPECT_FALSE(GlareOf(disk, {"-b", "9000"}).contains("ugr"));
  EXPECT_NEAR(GlareOf(disk, {"-b", "7"})["threshold_nits"].get<double>() /
                  GlareOf(disk)["mean_nits"].get<double>(),
              7.0, 1e-6);
  const json task = GlareOf(disk, {"--task", "100,250,100,20"});
  EXPECT_NEAR(task["task_nits"].get<double>(), 100.0, 1e-3);
  EXPECT_NEAR(task["threshold_nits"].get<double>(), 500.0, 0.01);
  // The sun in lobby_120_0 stands alone only where peaks are taken out.
  const std::string lobby = SampleData(kVectors + "lobby_120_0.hdr");
  EXPECT_LT(GlareOf(lobby, {"-x"})["sources"].size(), GlareOf(lobby)["sources"].size());
  EXPECT_EQ(GlareOf(lobby, {"-y", "-Y", "1e9"}), GlareOf(lobby, {"-x"}));
  EXPECT_LT(GlareOf(lobby, {"-r", "1"})["sources"].size(), GlareOf(lobby)["sources"].size());
}

// UGR of a disk of half angle a ahead, over 100 cd/m^2: w = 2 pi (1 - cos a), L_b = 100 cos^2 a.
double UgrOfDisk(double half_deg, double nits) {
  constexpr double pi = std::numbers::pi;
  const double cosine = std::cos(half_deg * pi / 180.0);
  const double background = 100.0 * cosine * cosine;
  return 8.0 * std::log10(0.25 / background * nits * nits * 2.0 * pi * (1.0 - cosine));
}

// An office's luminaire is below 2000 cd/m^2: UGR is by 5 times the mean, and DGP stays.
TEST(GlareCommand, WhatIsBelowTheThresholdOfDaylightStillHasItsUgr) {
  const TempDir dir;
  constexpr double kHalf = 6.0, pi = std::numbers::pi;
  const double part = 1.0 - std::cos(kHalf * pi / 180.0);  // of the half sphere
  // 600 cd/m^2 is 5.8 times the mean at any scale of the picture: the interval is 8 log10(1 -+ .2).
  for (const double nits : {600.0, 1900.0}) {
    const std::string disk = DiskPicture(dir, kHalf, static_cast<float>(nits), 600);
    const json glare = GlareOf(disk, {"--scale-u95", nits < 1000.0 ? "20%" : "2%"});
    const double scale = nits < 1000.0 ? 0.2 : 0.02;
    ASSERT_TRUE(glare.contains("ugr")) << nits;
    const double ugr = glare["ugr"]["value"].get<double>();
    EXPECT_NEAR(ugr, UgrOfDisk(kHalf, nits), 0.03);
    EXPECT_NEAR(glare["ugr"]["low95"].get<double>() - ugr, 8.0 * std::log10(1.0 - scale), 1e-3);
    EXPECT_NEAR(glare["ugr"]["high95"].get<double>() - ugr, 8.0 * std::log10(1.0 + scale), 1e-3);
    const double mean = 100.0 + (nits - 100.0) * part;
    EXPECT_NEAR(glare["ugr_threshold_nits"].get<double>() / (5.0 * mean), 1.0, 2e-3);
    EXPECT_EQ(glare["threshold_nits"], 2000.0);
    EXPECT_TRUE(glare["sources"].empty());
    EXPECT_FALSE(glare.contains("dgi") || glare.contains("cgi") ||
                 glare.contains("brightest_nits"));
    const json none = GlareOf(disk, {"-b", "2000", "--scale-u95", "2%"});
    EXPECT_FALSE(none.contains("ugr") || none.contains("brightest_nits")) << "as was asked";
    EXPECT_EQ(glare["dgp"]["value"], none["dgp"]["value"]);
    const json typed = GlareOf(disk, {"-b", "5", "--scale-u95", nits < 1000.0 ? "20%" : "2%"});
    EXPECT_EQ(typed["ugr"], glare["ugr"]) << "as many times the mean at any scale";
  }
  EXPECT_FALSE(GlareOf(DiskPicture(dir, kHalf, 8000.0F, 300)).contains("ugr_threshold_nits"));
  const std::string even = DiskPicture(dir, kHalf, 300.0F, 300);
  EXPECT_EQ(GlareOf(even)["brightest_nits"], 300.0);
  EXPECT_FALSE(GlareOf(even).contains("ugr"));
  const auto told = [](const std::string& file) {
    return RunLightcal({"inspect", file, "--glare", "--projection", "equidistant", "--fov", "180"})
        .out;
  };
  EXPECT_THAT(told(even), HasSubstr("the brightest is 300.0 cd/m²: -b"));
  const std::string office = told(DiskPicture(dir, kHalf, 1500.0F, 300));
  EXPECT_THAT(office, HasSubstr("unified glare rating"));
  EXPECT_THAT(office, HasSubstr("cd/m², 5 times the mean"));
}

// evalglare's -i: Ev from a meter, sources and E_d from the picture, L_b = (E_v - E_d)/pi.
TEST(GlareCommand, AStatedIlluminanceTakesThePlaceOfThePictures) {
  const TempDir dir;
  constexpr double kHalf = 6.0, kNits = 8000.0, kStated = 900.0, pi = std::numbers::pi;
  const std::string disk = DiskPicture(dir, kHalf, kNits, 900);
  const json glare = GlareOf(disk, {"-i", "900lx", "--scale-u95", "1%"});
  const double a = kHalf * pi / 180.0;
  const double direct = pi * kNits * std::pow(std::sin(a), 2);
  const double w = 2.0 * pi * (1.0 - std::cos(a));
  const double background = (kStated - direct) / pi;
  EXPECT_EQ(glare["ev_lx"], kStated);
  EXPECT_EQ(glare["ev_low95_lx"], kStated);
  EXPECT_EQ(glare["ev_high95_lx"], kStated);
  EXPECT_EQ(glare["ev_source"], "stated");
  EXPECT_NEAR(glare["ev_of_picture_lx"].get<double>() / GlareOf(disk)["ev_lx"].get<double>(), 1.0,
              1e-9);
  EXPECT_NEAR(glare["background_nits"].get<double>() / background, 1.0, 5e-3);
  EXPECT_NEAR(glare["ugr"]["value"].get<double>(),
              8.0 * std::log10(0.25 / background * kNits * kNits * w), 0.03);
  const double x = std::exp(0.024 * kStated - 4.0);
  const double dgp =
      (5.87e-5 * kStated + 0.0918 * std::log10(1.0 + kNits * kNits * w / std::pow(kStated, 1.87)) +
       0.16) *
      x / (1.0 + x);
  EXPECT_NEAR(glare["dgp"]["value"].get<double>(), dgp, 5e-4);
  EXPECT_EQ(GlareOf(disk)["ev_source"], "picture");
  const CliResult below = RunLightcal(
      {"inspect", disk, "--glare", "--projection", "equidistant", "--fov", "180", "-i", "200"});
  EXPECT_EQ(below.exit_code, 3);
  EXPECT_THAT(below.err, HasSubstr("more than the 200.0 lx of --glare-ev"));
}

TEST(GlareCommand, AViewLineSaysTheProjectionAndRadianceMeansItsOwnUnit) {
  const std::string file = SampleData(kVectors + "studio_60_10.hdr");
  std::string bytes = ReadFile(file);
  bytes.insert(bytes.find('\n') + 1, "VIEW= -vta -vv 180\n");
  const TempDir dir;
  const json got = LightcalJson("inspect", {dir.Write("a.pic", bytes), "--glare"});
  EXPECT_EQ(got["glare"], GlareOf(file));
  EXPECT_EQ(got["scale"]["source"], "radiance_179");
}

TEST(GlareCommand, WritesThePictureAndTheSources) {
  const TempDir dir;
  const std::string file = SampleData(kVectors + "lobby_0_0.hdr");
  const std::string png = dir.path() + "/sources.png", csv = dir.path() + "/sources.csv";
  const CliResult result = RunLightcal({"inspect", file, "--glare", "--projection", "equidistant",
                                        "--fov", "180", "-o", png, "-o", csv});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("daylight glare probability"));
  EXPECT_THAT(result.out, HasSubstr("nobody says: --scale-u95"));
  EXPECT_EQ(ReadFile(png).substr(1, 3), "PNG");
  const std::string table = ReadFile(csv);
  EXPECT_THAT(table, HasSubstr("luminance_cd_m2"));
  const auto rows = std::count(table.begin(), table.end(), '\n');
  EXPECT_EQ(rows, 2 + static_cast<long>(GlareOf(file)["sources"].size()));
}

TEST(GlareCommand, PixelsNoiseWidensTheInterval) {
  const TempDir dir;
  const std::string disk = DiskPicture(dir, 1.0, 8000.0F, 300);
  std::vector<float> sigma(300 * 300, 2000.0F);
  devices::ExrPicture picture;
  picture.samples = View2d<const float>(sigma.data(), 300, 300);
  picture.channel_names = {"Y"};
  picture.white_luminance = Nits(1.0);
  const std::string path = dir.path() + "/sigma.exr";
  ASSERT_TRUE(devices::WriteExr(path, picture));
  const json still = GlareOf(disk, {"--scale-u95", "1%"});
  const json noisy = GlareOf(disk, {"--scale-u95", "1%", "--sigma", path});
  EXPECT_EQ(noisy["ugr"]["value"], still["ugr"]["value"]);
  EXPECT_LT(noisy["ugr"]["low95"], still["ugr"]["low95"].get<double>() - 0.1);
  EXPECT_GT(noisy["ugr"]["high95"], still["ugr"]["high95"].get<double>() + 0.1);
}

TEST(GlareCommand, WhatCannotBeAnsweredIsRefused) {
  const std::string file = SampleData(kVectors + "lobby_0_0.hdr");
  const auto fails = [&](std::vector<std::string> words, int exit_code, const char* says) {
    words.insert(words.begin(), "inspect");
    const CliResult result = RunLightcal(words);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(says));
  };
  fails({file, "--glare"}, 3, "--projection equidistant");
  fails({file, "--glare", "--projection", "rect", "--fov", "90"}, 3, "sees less");
  fails({file, "--glare", "--projection", "equidistant", "--fov", "120"}, 3, "sees less");
  fails({file, "-b", "2000"}, 2, "--glare");
  fails({file, "--glare", "-b", "bright"}, 2, "2000cd/m2");
  fails({file, "--glare", "-r", "9"}, 2, "radians");
  fails({file, "--glare", "-i", "bright"}, 2, "850lx");
  fails({file, "-i", "850"}, 2, "--glare");
  fails({file, "--glare", "-o", "a.txt"}, 2, ".csv");
  fails({file, "--glare", "--projection", "equidistant", "--fov", "180", "--task", "0,0,3,3"}, 3,
        "outside the view");
  fails({SampleData("pictures/exr/Rec709.exr"), "--glare", "--projection", "equidistant", "--fov",
         "180"},
        3, "what 1.0 is");
}

}  // namespace
}  // namespace lightcal::test
