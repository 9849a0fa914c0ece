// SPDX-License-Identifier: Apache-2.0
// lightcal quick, driven as a shell would.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

json QuickJson(const std::vector<std::string>& arguments) {
  return LightcalJson("quick", arguments);
}

TEST(Quick, OneReadingAnswers48CandelaWideAndMarkedPrior) {
  const json known =
      QuickJson({"192lx@0.5m", "--cct", "2900K", "--room", "dark", "--fixture", "bulb"});
  EXPECT_NEAR(known["lights"][0]["intensity_cd"]["value"], 48.0, 1e-9);
  const json document = QuickJson({"192lx@0.5m", "--cct", "2900K"});
  const json& light = document["lights"][0];
  // Of an unknown lamp 28 in 100 seem to start 20 cm before their reference: 192 0.3^2 = 17 cd.
  EXPECT_GT(double(light["intensity_cd"]["u95"]), 0.5 * 48.0);
  EXPECT_LT(double(light["intensity_cd"]["u95"]), 0.9 * 48.0);
  EXPECT_LT(double(light["intensity_cd"]["low95"]), 30.0);
  EXPECT_NE(light["fit"]["prior"].dump().find("distance_offset"), std::string::npos);
  EXPECT_NEAR(light["color"]["cct_K"]["value"], 2900.0, 1.0);
  EXPECT_FALSE(std::string(document["next_step"]).empty());
  EXPECT_FALSE(light["fit"].contains("rms_relative"));
}

TEST(Quick, TheTableForPeopleSaysTheSameAndOneNextStep) {
  const CliResult result =
      RunLightcal({"quick", "192lx@0.5m", "--cct", "2900K", "--room", "dark", "--fixture", "bulb"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("48 cd"), std::string::npos) << result.out;
  const auto first = result.out.find(" better ");
  ASSERT_NE(first, std::string::npos) << result.out;
  EXPECT_EQ(result.out.find(" better ", first + 1), std::string::npos);
  const CliResult verbose = RunLightcal({"quick", "192lx@0.5m", "--cct", "2900K", "--room", "dark",
                                         "--fixture", "bulb", "--verbose"});
  EXPECT_NE(verbose.out.find("prior"), std::string::npos) << verbose.out;
}

// A panel's 125 lx at 2 m and 60 degrees are 250 before it; what may be a bulb or a beam has to be
// read there.
TEST(Quick, OneReadingOffTheAxisNeedsTheKind) {
  const std::vector<std::string> reading = {"125lx@2m,60deg", "--room", "dark"};
  std::vector<std::string> panel = reading;
  panel.insert(panel.end(), {"--kind", "rect", "--size", "0.3x0.3"});
  EXPECT_NEAR(QuickJson(panel)["lights"][0]["intensity_cd"]["value"], 1000.0, 10.0);
  std::vector<std::string> unknown = {"quick"};
  unknown.insert(unknown.end(), reading.begin(), reading.end());
  const CliResult refused = RunLightcal(unknown);
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("read at 0 degrees too"), std::string::npos) << refused.err;
}

struct Row {
  double distance_m;
  double illuminance_lx;
};

std::map<std::string, std::vector<Row>> PublishedTables() {
  std::ifstream file(SampleData("lux_tables/lux_tables.csv"));
  std::map<std::string, std::vector<Row>> tables;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::string fixture;
    std::string accessory;
    std::string cct;
    std::string distance;
    std::string lux;
    std::getline(cells, fixture, ',');
    std::getline(cells, accessory, ',');
    std::getline(cells, cct, ',');
    std::getline(cells, distance, ',');
    std::getline(cells, lux, ',');
    tables[fixture + "|" + accessory + "|" + cct].push_back({std::stod(distance), std::stod(lux)});
  }
  return tables;
}

TEST(Quick, TwoPublishedDistancesPredictTheFarthestAsOftenAsTheIntervalSays) {
  const auto tables = PublishedTables();
  ASSERT_EQ(tables.size(), 19U);
  int inside = 0;  // of makers' tables, read without walls
  for (const auto& [name, rows] : tables) {
    ASSERT_EQ(rows.size(), 3U) << name;
    const auto typed = [](const Row& row) {
      return std::to_string(row.illuminance_lx) + "lx@" + std::to_string(row.distance_m) + "m";
    };
    const json document = QuickJson({typed(rows[0]), typed(rows[1]), "--room", "dark", "--at",
                                     std::to_string(rows[2].distance_m) + "m"});
    const json& reading = document["predictions"][0]["reading_lx"];
    const double value = reading["value"];
    EXPECT_LT(double(reading["u95"]) / value, 0.16) << name;
    if (rows[2].illuminance_lx >= double(reading["low95"]) &&
        rows[2].illuminance_lx <= double(reading["high95"])) {
      ++inside;
    }
  }
  EXPECT_GE(inside, 18) << "of 19 tables";
}

TEST(Quick, ADataSheetsLumensAndBeamAnswerPeakCandelaWithAnInterval) {
  const json document = QuickJson({"--lumens", "806", "--beam", "36"});
  const json& intensity = document["lights"][0]["intensity_cd"];
  // A uniform cone of 36 degrees bounds the peak from above (2620 cd), a cos^n lobe with half its
  // peak at 18 degrees gives 1900 cd.
  EXPECT_GT(double(intensity["value"]), 1000.0);
  EXPECT_LT(double(intensity["value"]), 2621.0);
  EXPECT_LT(double(intensity["low95"]), 1900.0);
  EXPECT_GT(double(intensity["high95"]), 1900.0);
  EXPECT_EQ(document["lights"][0]["fit"]["learned"].size(), 0U);
}

TEST(Quick, FootcandlesAndInchesAreTheSameLamp) {
  const json metric = QuickJson({"191.59760555lx@50.8cm"});
  const json imperial = QuickJson({"17.8fc@20in"});
  EXPECT_NEAR(double(metric["lights"][0]["intensity_cd"]["value"]) /
                  double(imperial["lights"][0]["intensity_cd"]["value"]),
              1.0, 1e-6);
}

TEST(Quick, ReadingsMayFollowTheOptionsThatTakeLists) {
  const json document = QuickJson({"192lx@0.5m", "--at", "3m", "48lx@1m"});
  EXPECT_EQ(document["lights"][0]["fit"]["used"], 2);
  EXPECT_EQ(document["predictions"].size(), 1U);
}

TEST(Quick, SizesSayWhatShines) {
  const auto kind = [](std::vector<std::string> more) {
    more.insert(more.begin(), "900lx@2m");
    return std::string(QuickJson(more)["lights"][0]["kind"]);
  };
  EXPECT_EQ(kind({}), "point");
  EXPECT_EQ(kind({"--size", "90x60cm"}), "rect");
  EXPECT_EQ(kind({"--length", "1.2m", "--radius", "13mm"}), "tube");
  EXPECT_EQ(kind({"--beam", "36"}), "spot");
}

TEST(Quick, AColourMetersDuvIsTheColour) {
  // CIE 15: at 5600 K, .006 above the black body; `color` answers it by its own closed form.
  const json color =
      QuickJson({"900lx@2m", "--cct", "5600K", "--duv", "0.006"})["lights"][0]["color"];
  const json point = LightcalJson("color", {"--cct", "5600K", "--duv", "0.006"});
  EXPECT_NEAR(color["xy"][0], point["xy"][0], 1e-6);
  EXPECT_NEAR(color["xy"][1], point["xy"][1], 1e-6);
  EXPECT_EQ(QuickJson({"900lx@2m,5600K", "--duv", "0.006"})["lights"][0]["color"], color);
}

struct BadLine {
  std::vector<std::string> arguments;
  int exit_code;
  const char* says;
};

TEST(Quick, WrongLinesTeachAndWriteNothing) {
  const BadLine lines[] = {
      {{"quick"}, 2, "192lx@0.5m"},
      {{"quick", "192lx"}, 2, "ILLUMINANCE@DISTANCE"},
      {{"quick", "192lx@0m"}, 3, "above zero"},
      {{"quick", "192lx@-1m"}, 3, "above zero"},
      {{"quick", "-5lx@1m"}, 3, "negative"},
      {{"quick", "nanlx@1m"}, 2, "number"},
      {{"quick", "450lx@1m,15deg,25deg"}, 2, "second angle"},
      {{"quick", "203lx@1m,2900K,3500K"}, 2, "second colour temperature"},
      {{"quick", "203lx@1m,card=5lx,card=6lx"}, 2, "second shadow card"},
      {{"quick", "203lx@1m,off=5lx,2900K,off=5lx"}, 2, "second lamp off"},
      {{"quick", "203lx@1m,2m"}, 2, "ILLUMINANCE@DISTANCE"},
      {{"quick", "192lx@0.5parsec"}, 2, "unknown unit"},
      {{"quick", "192lx@0.5m", "--kind", "laser"}, 2, "laser"},
      {{"quick", "192lx@0.5m", "--cct", "-3K"}, 2, "above zero"},
      {{"quick", "192lx@0.5m", "--sigma", "500%"}, 2, "tolerance"},
      {{"quick", "192lx@0.5m", "--duv", "0.004"}, 2, "--cct"},
      {{"quick", "192lx@0.5m", "--cct", "2900K", "--duv", "green"}, 2, "0.004"},
      {{"quick", "192lx@0.5m", "--cct", "2900K", "--duv", "0.4"}, 3, "Duv"},
      {{"quick", "192lx@0.5m", "--nonsense"}, 2, "--nonsense"},
      {{"quikc"}, 2, "did you mean quick?"},
  };
  for (const BadLine& bad : lines) {
    const CliResult result = RunLightcal(bad.arguments);
    EXPECT_EQ(result.exit_code, bad.exit_code) << bad.arguments.back() << "\n" << result.err;
    EXPECT_NE(result.err.find(bad.says), std::string::npos) << bad.arguments.back() << "\n"
                                                            << result.err;
    EXPECT_EQ(result.out, "") << bad.arguments.back();
  }
}

TEST(Quick, WithJsonAnErrorIsOneDocumentToo) {
  const CliResult result = RunLightcal({"quick", "192lx@0m", "--json"});
  EXPECT_EQ(result.exit_code, 3);
  const json document = json::parse(result.out);
  EXPECT_EQ(document["error"]["code"], "bad_reading");
  EXPECT_EQ(document["error"]["subject"], "192lx@0m");
}

// A maker's figure is 95 %: 3 % of it are 3 %/1.96 of 1 sigma. With as many readings as one likes
// an interval stays above what they share. The figures are an inverse square's: no walls.
TEST(QuickMeter, AMakersFigureIsHis95PercentAndSharedByItsReadings) {
  const char* const sigma = "0.015306403707739618";  // 0.03/1.959964
  const std::vector<std::string> six = {"808lx@0.5m", "808lx@0.5m", "202lx@1m",
                                        "202lx@1m",   "50.5lx@2m",  "50.5lx@2m"};
  const auto u95 = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--room", "dark"});
    words.insert(words.end(), six.begin(), six.end());
    return double(QuickJson(words)["lights"][0]["intensity_cd"]["u95"]);
  };
  EXPECT_GT(u95({"--meter", "3%"}), 1.05 * u95({"--sigma", sigma}));
  EXPECT_LT(u95({"--meter", "3%"}), u95({"--meter", "6%"}));
  const json plan = QuickJson({"--plan", "--meter", "3%"});
  const json same = QuickJson({"--plan", "--sigma", sigma});
  EXPECT_EQ(plan["minutes"].dump(), same["minutes"].dump());
  EXPECT_EQ(RunLightcal({"quick", "52lx@1m", "--meter", "3%", "--sigma", "3%"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"quick", "52lx@1m", "--meter", "good"}).exit_code, 2);
}

TEST(QuickPlan, WithoutAReadingItSaysWhatMinutesBuy) {
  const json document = QuickJson({"--plan", "--sigma", "3%", "--reach", "2m"});
  EXPECT_FALSE(document.contains("lights"));
  const json& ladder = document["minutes"][0];
  EXPECT_FALSE(ladder.contains("u95_relative")) << "nothing is known yet";
  ASSERT_GE(ladder["steps"].size(), 2U);
  EXPECT_EQ(ladder["steps"][0]["total_minutes"], 5.0) << "a move and a reading";
  double left = 100.0;
  for (const json& step : ladder["steps"]) {
    EXPECT_LT(double(step["u95_relative"]), left);
    left = step["u95_relative"];
    if (step.contains("distance_m")) {
      EXPECT_LE(double(step["distance_m"]), 2.0);
    }
  }
}

TEST(QuickPlan, FromReadingsItDrawsAccuracyAgainstMinutes) {
  const TempDir dir;
  const std::string svg = dir.path() + "/minutes.svg";
  const CliResult result =
      RunLightcal({"quick", "52lx@1m", "--plan", "--minutes", "move=0,reading=1", "--plot", svg});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("as it is"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("light: now ± "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("; 1 minute (read at 0.500 m, facing the lamp) leaves ± "),
            std::string::npos)
      << result.out;
  EXPECT_NE(ReadFile(svg).find("minutes of measuring"), std::string::npos);
}

// Readings that contradict one another, outdoors: what a card would leave was 1 % of the light or
// nothing, as two roundings fell.
TEST(QuickPlan, TheAdviceDoesNotHangOnTheTenthDigit) {
  std::set<std::string> advice;
  for (const char* lux : {"43.58", "43.589", "43.5899", "43.59", "43.5901", "43.591", "43.6"}) {
    advice.insert(
        QuickJson({std::string(lux) + "lx@1m,card=2.268lx", "19.76lx@1.5m", "12.52lx@2m", "--cct",
                   "6372K", "--meter", "phone", "--room", "outdoors"})["next_step"]);
  }
  EXPECT_EQ(advice.size(), 1U) << testing::PrintToString(advice);
}

TEST(Quick, ABulbsAngleIsNoBeamAndItSaysWhatToWrite) {
  for (const char* wide : {"170", "200", "240deg"}) {
    const CliResult result = RunLightcal({"quick", "--lumens", "806", "--beam", wide});
    EXPECT_EQ(result.exit_code, 2) << wide;
    EXPECT_NE(result.err.find("below 170 degrees"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--fixture bulb"), std::string::npos) << result.err;
  }
}

TEST(QuickPlan, AskedWrongItSaysWhatToWrite) {
  for (const char* wrong : {"card", "cards=1", "move=-1", "move=soon"}) {
    const CliResult result = RunLightcal({"quick", "--plan", "--minutes", wrong});
    EXPECT_EQ(result.exit_code, 2) << wrong;
    EXPECT_NE(result.err.find("reading=2,card=1,move=3"), std::string::npos) << result.err;
  }
  EXPECT_EQ(RunLightcal({"quick", "52lx@1m", "--reach", "2m"}).exit_code, 2) << "no --plan";
  EXPECT_EQ(RunLightcal({"quick", "--plan", "--plot", "minutes.gif"}).exit_code, 2);
}

// The cone nearest to this beam has no even middle: 0, and not 9.3e-08.
TEST(Quick, AnInnerAngleThatIsNoneIsZero) {
  const TempDir folder;
  const std::string out = folder.path() + "/p";
  ASSERT_EQ(RunLightcal({"quick", "600lx@5m", "--beam", "36", "--to", "gltf", "-o", out}).exit_code,
            0);
  const json light =
      json::parse(ReadFile(out + "/light.gltf"))["extensions"]["KHR_lights_punctual"]["lights"][0];
  EXPECT_EQ(double(light["spot"]["innerConeAngle"]), 0.0);
}

}  // namespace
}  // namespace lightcal::test
