// SPDX-License-Identifier: Apache-2.0
// lightcal tradeoff, driven as a shell would: what it recommends must hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json ReadJson(const fs::path& path) { return json::parse(std::ifstream(path)); }

double Strength(const json& light) {
  if (light.contains("intensity_cd")) return light["intensity_cd"]["value"];
  return light["illuminance_lx"]["value"];
}

// What every knob at its strictest says, written by hand: the file the study measures against.
constexpr const char* kStrict = R"({"schema": "lightcal.profile/1", "effects": "all",
  "tolerance_relative": 0.01, "estimator": {"solver": "full", "bounce_patches": 48}})";

// The largest change of any light's strength and colour between fits by two profiles, relative,
// with 1 % = 1 mired.
double Apart(const std::string& session, const std::string& a, const std::string& b) {
  const TempDir dir;
  const json one =
      LightcalJson("fit", {session, "--profile", a, "-o", dir.path() + "/a.json", "--force"});
  const json two =
      LightcalJson("fit", {session, "--profile", b, "-o", dir.path() + "/b.json", "--force"});
  double apart = 0.0;
  for (std::size_t i = 0; i < one["lights"].size(); ++i) {
    const json &x = one["lights"][i], &y = two["lights"][i];
    apart = std::max(apart, std::abs(std::log(Strength(x) / Strength(y))));
    if (!x.contains("color") || !x["color"].contains("cct_K")) continue;
    const double mired =
        1e6 / double(x["color"]["cct_K"]["value"]) - 1e6 / double(y["color"]["cct_K"]["value"]);
    apart = std::max(apart, std::abs(mired) / 100.0);
  }
  return apart;
}

struct Sample {
  const char* session;
  int least_in_play;
};
class Tradeoff : public ::testing::TestWithParam<Sample> {};

TEST_P(Tradeoff, ShowsWhatEachKnobCostsAndRecommendsWhatHolds) {
  const std::string session = SampleData(std::string("sessions/") + GetParam().session);
  const TempDir dir;
  const std::string out = dir.path() + "/out";
  const json answer = LightcalJson("tradeoff", {session, "--tol", "1%", "-o", out});
  std::set<std::string> knobs;
  int in_play = 0;
  for (const json& row : answer["knobs"]) {
    knobs.insert(row["knob"]);
    in_play += bool(row["in_play"]) ? 1 : 0;
    if (row.contains("refused")) continue;
    EXPECT_GE(int(row["time_ms"]["runs"]), 3);
    EXPECT_GT(double(row["time_ms"]["median"]), 0.0);
    EXPECT_TRUE(row.contains("error_relative") && row.contains("label"));
  }
  EXPECT_GE(knobs.size(), 10U);
  EXPECT_GE(in_play, GetParam().least_in_play);
  EXPECT_LE(double(answer["recommended"]["error_relative"]), double(answer["allowed_relative"]));

  for (const char* name :
       {"profile.json", "tradeoff.json", "tradeoff.svg", "tradeoff.png", "tradeoff.html"}) {
    EXPECT_TRUE(fs::exists(fs::path(out) / name)) << name;
  }
  const std::string strict = dir.path() + "/strict.json";
  std::ofstream(strict) << kStrict;
  EXPECT_NEAR(Apart(session, out + "/profile.json", strict),
              double(answer["recommended"]["error_relative"]), 1e-6);
  EXPECT_EQ(ReadJson(out + "/profile.json")["measured"]["label"], answer["recommended"]["label"]);
}
INSTANTIATE_TEST_SUITE_P(Of, Tradeoff,
                         ::testing::Values(Sample{"three_real_lights", 3},
                                           Sample{"grey_card_exr", 4}),
                         [](const auto& sample) { return sample.param.session; });

// A random session: 4 to 8 readings of a bulb, disk or panel, in a room or not, by a meter of 0.5
// to 5 %.
std::string TwinToml(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> normal;
  const double sigma = std::pow(10.0, -2.3 + share(random));
  const double intensity = std::pow(10.0, 1.0 + 3.0 * share(random));
  const double offset = 0.05 * share(random) - 0.02;
  const int kind = static_cast<int>(3.0 * share(random));
  std::string text = "lightcal = 1\nname = \"twin\"\n";
  const bool in_room = share(random) < 0.5;
  if (in_room) {
    text += "[room]\nsize_m = [6.0, 5.0, 2.8]\nreflectance = " +
            std::to_string(0.1 + 0.6 * share(random)) + "\n";
  }
  text += "[[light]]\nname = \"key\"\n";
  if (kind == 0) text += "kind = \"point\"\n";
  if (kind == 1) text += "kind = \"disk\"\ndiameter_m = 0.2\naim = [1, 0, 0]\n";
  if (kind == 2) text += "kind = \"rect\"\nsize_m = [0.6, 0.3]\naim = [1, 0, 0]\n";
  text += "[[meter]]\nname = \"m\"\nsigma_relative = " + std::to_string(sigma) + "\n";
  // In the room the meter stays inside it: 2.2 m from the lamp in its middle.
  const int count = 4 + static_cast<int>((in_room ? 2.0 : 5.0) * share(random));
  for (int i = 0; i < count; ++i) {
    const double d = 0.5 * std::pow(1.45, i);
    const double area = kind == 0 ? 0.0 : kind == 1 ? 0.01 : 0.018;
    const double lux =
        intensity / ((d + offset) * (d + offset) + area) * std::exp(sigma * normal(random));
    text += "[[reading]]\nlight = \"key\"\nmeter = \"m\"\ndistance_m = " + std::to_string(d) +
            "\nilluminance_lx = " + std::to_string(lux) + "\n";
  }
  return text;
}

TEST(TradeoffTwins, TheRecommendationMeetsTheTolerance) {
  std::mt19937_64 random(20261122);
  for (int i = 0; i < 20; ++i) {
    const TempDir dir;
    const std::string session = dir.path() + "/twin.toml";
    const std::string toml = TwinToml(random);
    SCOPED_TRACE(toml);
    std::ofstream(session) << toml;
    const json answer = LightcalJson(
        "tradeoff", {session, "--tol", "2%", "--knobs",
                     "effects,source_model,bounce_patches,solver,rejection", "-o", dir.path()});
    if (!answer.contains("recommended")) continue;
    std::ofstream(dir.path() + "/strict.json") << kStrict;
    EXPECT_LE(Apart(session, dir.path() + "/profile.json", dir.path() + "/strict.json"),
              double(answer["allowed_relative"]) + 1e-9)
        << i;
  }
}

TEST(TradeoffCommand, ABudgetThatNothingMeetsIsRefusedWithTheNearest) {
  const CliResult result = RunLightcal({"tradeoff", SampleData("sessions/three_real_lights"),
                                        "--budget", "0.001ms", "--knobs", "solver", "--json"});
  EXPECT_EQ(result.exit_code, 3);
  const json error = json::parse(result.out)["error"];
  EXPECT_EQ(error["code"], "no_setting");
  EXPECT_NE(std::string(error["message"]).find("nearest"), std::string::npos);
}

TEST(TradeoffCommand, AskedWrongItSaysWhatToWrite) {
  const std::string session = SampleData("sessions/three_real_lights");
  EXPECT_EQ(RunLightcal({"tradeoff", session, "--budget", "soon"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"tradeoff", session, "--tol", "200%"}).exit_code, 2);
  const CliResult result = RunLightcal({"tradeoff", session, "--knobs", "sovler"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("solver"), std::string::npos);
}

TEST(TradeoffProfile, AnUnknownKeyIsNamed) {
  const TempDir dir;
  std::ofstream(dir.path() + "/p.json")
      << R"({"schema": "lightcal.profile/1", "estimator": {"solvr": "quick"}})";
  const CliResult result = RunLightcal(
      {"fit", SampleData("sessions/three_real_lights"), "--profile", dir.path() + "/p.json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("solver"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace lightcal::test
