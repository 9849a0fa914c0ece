// SPDX-License-Identifier: Apache-2.0
// Sessions whose pictures a profile has merged smaller or otherwise: the same lamp, in less time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "plain_exr.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "synthetic_wall.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

// Frames at f/8 and ISO 100, where 1 is 120 N^2/(t S), that end at 1: FOLDER/frame_0.exr ...
// Returns the lines that say so.
std::string Shoot(const TempDir& folder, const std::vector<float>& nits, int width, int height,
                  const std::vector<double>& times) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::string list;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double full = 120.0 * 64.0 / (times[i] * 100.0);
    std::vector<float> samples;
    samples.reserve(nits.size());
    for (const float v : nits) {
      const double signal = v / full;
      const double noise = std::sqrt(signal / 20000.0 + 1e-8) * normal(random);
      samples.push_back(static_cast<float>(std::min(1.0, signal + noise)));
    }
    folder.Write("captures/frame_" + std::to_string(i) + ".exr", EncodeExr(width, height, samples));
    list += (list.empty() ? "" : ", ") + std::to_string(times[i]);
  }
  return "frames = \"captures/frame_*.exr\"\nf_number = 8\niso = 100\nexposure_s = [" + list +
         "]\n";
}

struct Pictures {
  const char* name;
  int stride;
  bool average;
  const char* estimator;
};
constexpr Pictures kUsual = {"usual", 1, false, "likelihood"};
constexpr Pictures kOthers[] = {
    {"half_averaged", 2, true, "likelihood"},
    {"half", 2, false, "likelihood"},
    {"quarter_averaged", 4, true, "sums"},
    {"quarter", 4, false, "longest"},
    {"sums", 1, false, "sums"},
    {"longest", 1, false, "longest"},
};

// The first light of the session's fit with its pictures done so.
json LightBy(const TempDir& folder, const Pictures& pictures) {
  const json profile = {{"schema", "lightcal.profile/1"},
                        {"pictures",
                         {{"pixel_stride", pictures.stride},
                          {"average_pixels", pictures.average},
                          {"estimator", pictures.estimator}}}};
  const std::string path = folder.Write("profile.json", profile.dump());
  return LightcalJson("fit", {folder.path() + "/session.toml", "--profile", path, "-o",
                              folder.path() + "/light.json", "--force"})["lights"]
      .at(0);
}

double Value(const json& light, const char* key) { return light[key]["value"]; }
double U95(const json& light, const char* key) {
  return 0.5 * (double(light[key]["high95"]) - double(light[key]["low95"]));
}

// A disk of 5000 cd/m^2 and 0.1 m radius, 1 m away, in a room of 3: seen straight on, 40 degrees
// across a width that no block divides.
std::vector<float> PictureOfDisk(int width, int height) {
  const double focal = 0.5 * width / std::tan(20.0 * std::numbers::pi / 180.0);
  std::vector<float> nits;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int hits = 0;
      for (int i = 0; i < 16; ++i) {
        const double right = (x + (i % 4 + 0.5) / 4.0 - 0.5 * width) / focal - 0.04;
        const double up = (0.5 * height - y - (i / 4 + 0.5) / 4.0) / focal;
        hits += std::hypot(right, up) < 0.1 ? 1 : 0;
      }
      nits.push_back(static_cast<float>(3.0 + 4997.0 * hits / 16.0));
    }
  }
  return nits;
}

void WriteSourceSession(const TempDir& folder, int width, int height) {
  const std::string frames =
      Shoot(folder, PictureOfDisk(width, height), width, height, {1.0 / 400, 1.0 / 100, 1.0 / 25});
  folder.Write("session.toml",
               "lightcal = 1\n[[light]]\nname = \"lamp\"\nkind = \"disk\"\n[[capture]]\n"
               "light = \"lamp\"\nuse = \"source\"\ndistance_m = 1.0\nfov_deg = 40\n" +
                   frames);
}

TEST(SmallerPictures, ALampsOwnPictureKeepsItsIntensityAndSize) {
  const TempDir folder;
  WriteSourceSession(folder, 1003, 751);
  const json usual = LightBy(folder, kUsual);
  EXPECT_NEAR(double(usual["diameter_m"]) / 0.2, 1.0, 0.005);
  for (const Pictures& pictures : kOthers) {
    SCOPED_TRACE(pictures.name);
    const json light = LightBy(folder, pictures);
    // Left out pixels miss the edge by a share of themselves: 0.3 % of a disk of 70 pixels' radius.
    const double edge = pictures.average || pictures.stride == 1 ? 0.002 : 0.006;
    EXPECT_NEAR(Value(light, "intensity_cd") / Value(usual, "intensity_cd"), 1.0, edge);
    EXPECT_NEAR(Value(light, "luminance_nits") / Value(usual, "luminance_nits"), 1.0, 0.004);
    EXPECT_NEAR(double(light["diameter_m"]) / double(usual["diameter_m"]), 1.0, 0.005);
    EXPECT_NEAR(U95(light, "intensity_cd") / U95(usual, "intensity_cd"), 1.0, 0.02);
  }
}

TEST(SmallerPictures, TradeoffShowsWhatTheyCostALampsOwnPicture) {
  const TempDir folder;
  WriteSourceSession(folder, 503, 371);
  const json answer =
      LightcalJson("tradeoff", {folder.path() + "/session.toml", "--knobs", "pixels"});
  std::vector<std::string> seen;
  for (const json& row : answer["knobs"]) {
    seen.push_back(row["level"]);
    EXPECT_LT(double(row["error_relative"]), 0.01) << row;
    if (row["level"] != "quarter") continue;
    EXPECT_LT(double(row["time_ms"]["stages"]["pictures"]),
              double(answer["usual"]["time_ms"]["stages"]["pictures"]));
    EXPECT_TRUE(row["in_play"]);
  }
  for (const char* level : {"half averaged", "half", "quarter averaged", "quarter"}) {
    EXPECT_EQ(std::ranges::count(seen, level), 1) << level;
  }
}

TEST(SmallerPictures, AWallKeepsItsDistribution) {
  const TempDir folder;
  LightcalJson("plan", {"--board", folder.path() + "/board.svg"});
  SyntheticWall wall;
  wall.board = RectanglesOfSvg(ReadFile(folder.path() + "/board.svg"));
  wall.intensity = SpotInAGlow;
  wall.width = 800;
  wall.height = 600;
  wall.focal_px = 640.0;
  wall.noise_relative = 0.0;
  folder.Write("board.exr", EncodeExr(wall.width, wall.height, PhotographWall(wall)));
  SyntheticWall bare = wall;
  bare.board.clear();
  const std::string frames =
      Shoot(folder, PhotographWall(bare), wall.width, wall.height, {1.0 / 125, 1.0 / 30, 1.0 / 8});
  wall.looks_at = {0.13, 0.0, 0.09};
  wall.camera = {-0.4, -0.5, 0.4};
  folder.Write("views/board.exr", EncodeExr(wall.width, wall.height, PhotographWall(wall)));
  folder.Write("session.toml",
               "lightcal = 1\n[[light]]\nname = \"spot\"\nkind = \"photometric\"\n"
               "position_m = [0.5, -1.0, 0.35]\naim = [0, 1, 0]\n[[capture]]\nlight = \"spot\"\n"
               "use = \"wall\"\nreflectance = 0.8\n" +
                   frames +
                   "[capture.wall]\nsquare_m = 0.03\nboard_frame = \"board.exr\"\n"
                   "board_views = \"views/*.exr\"\nposition_sigma_m = 0.01\nvignetting = 3.5\n"
                   "masks = [0, 560, 60, 40]\n");
  // Flux over what truly leaves within the cone that was seen, which ends with the last block.
  const auto flux_share = [](const json& light) {
    const double seen_deg = light["distribution"]["vertical_deg"].back();
    return Value(light, "flux_lm") / TruthWithin(SpotInAGlow, {0, 1, 0}, seen_deg).flux_lm;
  };
  const json usual = LightBy(folder, kUsual);
  for (const Pictures& pictures : {kOthers[0], kOthers[3]}) {
    SCOPED_TRACE(pictures.name);
    const json light = LightBy(folder, pictures);
    EXPECT_NEAR(Value(light, "intensity_cd") / Value(usual, "intensity_cd"), 1.0, 0.01);
    EXPECT_NEAR(flux_share(light) / flux_share(usual), 1.0, 0.003);
  }
}

}  // namespace
}  // namespace lightcal::test
