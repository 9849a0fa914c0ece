// SPDX-License-Identifier: Apache-2.0
// A session whose lamp has no position and whose readings have theirs, through the program.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <string>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using Point = std::array<double, 3>;

constexpr const char* kLocatedHead =
    "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
    "[[meter]]\nname = \"m\"\nsigma_relative = 0.01\n";

// A meter on the floor below a point of 900 cd.
std::string OnFloor(const Point& meter, const Point& lamp, double noise) {
  const double dx = lamp[0] - meter[0];
  const double dy = lamp[1] - meter[1];
  const double h = lamp[2] - meter[2];
  const double lux = 900.0 * h / std::pow(dx * dx + dy * dy + h * h, 1.5) * std::exp(noise);
  return "[[reading]]\nlight = \"key\"\nmeter = \"m\"\nnormal = [0, 0, 1]\nposition_m = [" +
         std::to_string(meter[0]) + ", " + std::to_string(meter[1]) + ", " +
         std::to_string(meter[2]) + "]\nilluminance_lx = " + std::to_string(lux) + "\n";
}

const std::array<Point, 4> kCorners = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

TEST(LocateByProgram, ASquareAndItsCentreTellPositionAndIntensity) {
  std::mt19937_64 random(61);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  int covered = 0;
  constexpr int kTwins = 20;
  for (int i = 0; i < kTwins; ++i) {
    const Point lamp{uniform(random) - 0.5, uniform(random) - 0.5, 1.2 + uniform(random)};
    std::string text = kLocatedHead;
    for (const Point& p : kCorners) text += OnFloor(p, lamp, 0.01 * normal(random));
    text += OnFloor({0, 0, 0}, lamp, 0.01 * normal(random));
    const TempDir folder;
    const std::string session = folder.Write("session.toml", text);
    const json light = LightcalJson("fit", {session, "-o", folder.path() + "/l.json"})["lights"][0];
    for (std::size_t k = 0; k < 3; ++k) {
      const double u95 = light["position_u95_m"][k];
      EXPECT_LT(u95, 0.2);
      covered += std::abs(double(light["position_m"][k]) - lamp[k]) <= u95 ? 1 : 0;
    }
    EXPECT_NEAR(double(light["intensity_cd"]["value"]), 900.0, 150.0);
    EXPECT_FALSE(light.contains("distance_offset_m"));
  }
  EXPECT_GE(covered, 3 * kTwins * 9 / 10);
}

TEST(LocateByProgram, ASquareAloneIsRefusedAndTheReadingItAsksForCuresIt) {
  const Point lamp{0.3, -0.2, 1.6};
  std::string text = kLocatedHead;
  for (const Point& p : kCorners) text += OnFloor(p, lamp, 0.0);
  const TempDir folder;
  const std::string session = folder.Write("session.toml", text);
  const CliResult refused = RunLightcal({"run", session, "-o", folder.path() + "/out", "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  const json error = json::parse(refused.out)["error"];
  EXPECT_EQ(error["code"], "cocircular");
  EXPECT_EQ(error["subject"], "key");
  const std::string message = error["message"];
  std::smatch place;
  ASSERT_TRUE(std::regex_search(
      message, place, std::regex("position_m = \\[([0-9.-]+), ([0-9.-]+), ([0-9.-]+)\\]")))
      << message;
  text += OnFloor({std::stod(place[1]), std::stod(place[2]), std::stod(place[3])}, lamp, 0.0);
  folder.Write("session.toml", text);
  const CliResult run = RunLightcal({"run", session, "-o", folder.path() + "/out"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("stands at"), std::string::npos) << run.out;
  const std::string report = ReadFile(folder.path() + "/out/report.html");
  EXPECT_NE(report.find("Position found"), std::string::npos);
  const json light = json::parse(ReadFile(folder.path() + "/out/light.json"))["lights"][0];
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(double(light["position_m"][k]), lamp[k], 1e-3);
}

}  // namespace
}  // namespace lightcal::test
