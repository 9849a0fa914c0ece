// SPDX-License-Identifier: Apache-2.0
// lightcal inspect, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "synthetic_dng.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct Panorama {
  const char* name;
  // Of Y cos over the upper hemisphere. The figures published with the files (13.897308, 2.270770,
  // 3.220279) are of mantissas as they stand; these, by the same sum, of (m + 1/2) as Radiance
  // reads.
  double integral;
  int x, y;  // the brightest pixel, likewise
};
class RealPanorama : public testing::TestWithParam<Panorama> {};
INSTANTIATE_TEST_SUITE_P(PolyHaven, RealPanorama,
                         testing::Values(Panorama{"studio", 13.941692, 235, 133},
                                         Panorama{"sunset", 2.280526, 614, 247},
                                         Panorama{"lobby", 3.230971, 27, 175}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST_P(RealPanorama, GivesThePublishedHorizontalIntegralAndBrightestPixel) {
  const Panorama& p = GetParam();
  const std::string path = SampleData(std::string("pictures/latlong/") + p.name + ".hdr");
  const json got = LightcalJson("inspect", {path, "--projection", "latlong"});
  EXPECT_NEAR(got["illuminance_lx"].get<double>() / p.integral, 1.0, 1e-3);
  EXPECT_NEAR(got["solid_angle_sr"].get<double>(), 4.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(got["peak"]["x"], p.x);
  EXPECT_EQ(got["peak"]["y"], p.y);
  EXPECT_NEAR(got["peak"]["elevation_deg"].get<double>(), 90.0 - 180.0 * (p.y + 0.5) / 512.0, 1e-9);
  // No file says what 1.0 is: that is said, and refused when strictness is asked for.
  EXPECT_EQ(got["scale"]["source"], "assumed_nits");
  EXPECT_EQ(got["warnings"][0]["code"], "relative_scale");
  EXPECT_EQ(RunLightcal({"inspect", path, "--strict"}).exit_code, 3);
}

TEST(InspectCommand, ConventionsDifferByTheirEfficacy) {
  const std::string path = SampleData("pictures/latlong/lobby.hdr");
  const auto mean = [&](const char* convention) {
    return LightcalJson("inspect",
                        {path, "--luminance-convention", convention})["luminance_nits"]["mean"]
        .get<double>();
  };
  EXPECT_NEAR(mean("radiometric") / mean("photometric"), 683.0, 1e-3);
  const double radiance = mean("radiance") / mean("photometric");
  EXPECT_GT(radiance, 179.0 * 0.8);
  EXPECT_LT(radiance, 179.0 * 1.2);
}

TEST(InspectCommand, RgbAndLuminanceChromaReadAlike) {
  const auto mean = [](const char* name) {
    return LightcalJson("inspect",
                        {SampleData(std::string("pictures/exr/") + name)})["luminance_nits"]["mean"]
        .get<double>();
  };
  EXPECT_NEAR(mean("Rec709.exr"), 0.284656, 3e-4);
  EXPECT_NEAR(mean("Rec709_YC.exr") / mean("Rec709.exr"), 1.0, 1e-3);
}

// A disk of 5 degrees half angle and 1000 cd/m^2 in the middle of an equisolid fisheye:
// E = pi L sin^2(5 deg).
TEST(InspectCommand, ALampInAFisheyeGivesItsIlluminance) {
  constexpr int kSize = 600;
  constexpr double kHalf = 5.0 * std::numbers::pi / 180.0;
  const double f = kSize / 2.0 / (2.0 * std::sin(std::numbers::pi / 4.0));
  const double radius = 2.0 * f * std::sin(kHalf / 2.0);
  std::vector<float> nits(std::size_t{kSize} * kSize);
  constexpr int kParts = 16;  // of a pixel's side: what the lamp covers of it
  for (int y = 0; y < kSize * kParts; ++y) {
    for (int x = 0; x < kSize * kParts; ++x) {
      const double cx = (x + 0.5) / kParts - kSize / 2.0, cy = (y + 0.5) / kParts - kSize / 2.0;
      if (cx * cx + cy * cy > radius * radius) continue;
      nits[static_cast<std::size_t>(y / kParts) * kSize + x / kParts] +=
          1000.0F / (kParts * kParts);
    }
  }
  const TempDir dir;
  const std::string path = dir.path() + "/fisheye.exr";
  devices::ExrPicture picture;
  picture.samples = View2d<const float>(nits.data(), kSize, kSize);
  picture.channel_names = {"Y"};
  picture.white_luminance = Nits(1.0);
  picture.attributes = {{"scale_source", "anchor"}, {"scale_u95_relative", "0.02"}};
  ASSERT_TRUE(devices::WriteExr(path, picture));

  const json got = LightcalJson("inspect", {path, "--projection", "equisolid", "--fov", "180"});
  const double truth = std::numbers::pi * 1000.0 * std::pow(std::sin(kHalf), 2);
  EXPECT_NEAR(got["illuminance_lx"].get<double>() / truth, 1.0, 1e-3);
  EXPECT_NEAR(got["solid_angle_sr"].get<double>(), 2.0 * std::numbers::pi, 1e-3);
  EXPECT_EQ(got["luminance_nits"]["max"], 1000.0);
  EXPECT_EQ(got["scale"]["source"], "anchor");
  EXPECT_EQ(got["scale"]["u95_relative"], 0.02);
  // Drawn as flat as what is cut off, which is all that is said of it.
  ASSERT_EQ(got["warnings"].size(), 1U);
  EXPECT_EQ(got["warnings"][0]["code"], "maybe_clipped");

  const json part = LightcalJson("inspect", {path, "--rect", "298,298,4,4"});
  EXPECT_EQ(LightcalJson("inspect", {"--rect", "298", "298", "4", "4", path}), part);
  EXPECT_EQ(LightcalJson("inspect", {"--rect", "298,298,4,4", path}), part);
  EXPECT_EQ(part["luminance_nits"]["min"], 1000.0);
  EXPECT_EQ(part["sigma_relative"], 0.0);
  EXPECT_FALSE(part.contains("illuminance_lx"));
}

// The synthetic camera is as sensitive as its ISO says.
TEST(InspectCommand, ARawOfACardReadsItsLuminanceByTheIsoPrior) {
  SyntheticCamera camera;
  camera.width = 120;
  camera.height = 80;
  const SyntheticExposure exposure;
  const TempDir dir;
  const std::string path = dir.Write(
      "card.dng", EncodeDng(camera, exposure,
                            Expose(camera, exposure, [](int, int) { return XyzOf(1000.0); })));
  const json got = LightcalJson("inspect", {path, "--rect", "20,20,80,40"});
  EXPECT_NEAR(got["luminance_nits"]["mean"].get<double>() / 1000.0, 1.0, 0.01);
  EXPECT_EQ(got["scale"]["source"], "iso_prior");
  EXPECT_GT(got["scale"]["u95_relative"].get<double>(), 0.2);
}

TEST(InspectCommand, ARawWithoutExposureIsRefusedUntilItIsGiven) {
  const std::string path = SampleData("raw/colorchart.dng");
  const CliResult refused = RunLightcal({"inspect", path, "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(json::parse(refused.out)["error"]["code"], "no_exposure_metadata");
  const json given =
      LightcalJson("inspect", {path, "--exposure", "1/50", "--f-number", "5.6", "--iso", "100"});
  EXPECT_GT(given["luminance_nits"]["mean"].get<double>(), 0.0);
  EXPECT_EQ(given["picture"]["width"], 1734);
}

TEST(InspectCommand, TheKodakDecodes) {
  const json got = LightcalJson("inspect", {SampleData("raw/kodak_dc50.kdc")});
  EXPECT_EQ(got["picture"]["width"], 768);
  EXPECT_EQ(got["picture"]["height"], 512);
  EXPECT_GT(got["luminance_nits"]["median"].get<double>(), 0.0);
}

TEST(InspectCommand, CodesWithoutAResponseAreRefused) {
  const CliResult result =
      RunLightcal({"inspect", SampleData("pictures/own/ramp_8bit.jpg"), "--json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "no_response");
}

TEST(InspectCommand, AskedWrongItSaysWhatToWrite) {
  const std::string path = SampleData("pictures/latlong/lobby.hdr");
  const auto fails = [&](std::vector<std::string> arguments, int exit_code, const char* says) {
    arguments.insert(arguments.begin(), {"inspect", path});
    const CliResult result = RunLightcal(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(says));
  };
  fails({"--projection", "latlon"}, 2, "did you mean latlong?");
  fails({"--projection", "equisolid"}, 2, "--fov");
  fails({"--projection", "rect", "--fov", "190"}, 3, "between 0 and 180");
  fails({"--fov", "90"}, 2, "--projection");
  fails({"--rect", "1,2,3"}, 2, "x,y,width,height");
  fails({"--rect", "1000,0,100,100"}, 3, "1024 x 512");
  fails({"--luminance-convention", "lumens"}, 2, "photometric");
  const CliResult missing = RunLightcal({"inspect", "no_such.exr"});
  EXPECT_EQ(missing.exit_code, 1);
}

TEST(InspectCommand, PeopleGetATableWithUnits) {
  const CliResult result = RunLightcal(
      {"inspect", SampleData("pictures/latlong/studio.hdr"), "--projection", "latlong"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("illuminance, upper hemisphere"));
  EXPECT_THAT(result.out, HasSubstr("235,133"));
  EXPECT_THAT(result.err, HasSubstr("does not say which luminance 1.0 is"));
}

}  // namespace
}  // namespace lightcal::test
