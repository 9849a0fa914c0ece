// SPDX-License-Identifier: Apache-2.0
// A session whose lamp has no position and whose readings have theirs, through the program.
#include <gtest/gtest.h>

#include <algorithm>
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

// ---- in a room ----

// Lux of a bulb of 1 cd at (5.8731, 3.4414, 1.6692) m on tables of room 18 of
// tests/tools/traced_rooms/traced_places.csv: from itself, from the walls, behind a card half way.
struct TableReading {
  const char* position_m;
  double direct, wall, card;
};
constexpr std::array<TableReading, 7> kTables = {
    {{"[3.9968, 2.8922, 0.76]", .09071, .07336, .07268},
     {"[5.1432, 3.0233, 0.76]", .47845, .1123, .1102},
     {"[5.5439, 3.0171, 0.76]", .77218, .1254, .1226},
     {"[4.3409, 4.5664, 0.76]", .09718, .08182, .08132},
     {"[5.6200, 4.6179, 0.76]", .26499, .1298, .1281},
     {"[4.8700, 2.9436, 0.76]", .30294, .1024, .1008},
     {"[3.5602, 3.4910, 0.76]", .0592, .07216, .07105}}};
constexpr Point kBulb = {5.8731, 3.4414, 1.6692};

// 500 cd, cards read at the first so many tables.
std::string BulbOverTables(std::size_t cards, const std::string& sheet = "") {
  std::string text =
      "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
      "lamp_class = \"white_led\"\nminutes_on = 600\nflicker_depth = 0.0\n" +
      sheet + "[[meter]]\nname = \"m\"\nsigma_relative = 0.03\ncosine_f2 = 0.0\n";
  const auto add = [&text](const TableReading& at, double lux, const char* more) {
    text += std::string("[[reading]]\nlight = \"key\"\nmeter = \"m\"\nnormal = [0, 0, 1]\n") +
            "position_m = " + at.position_m + "\nilluminance_lx = " + std::to_string(500.0 * lux) +
            "\n" + more;
  };
  for (std::size_t i = 0; i < kTables.size(); ++i) {
    add(kTables[i], kTables[i].direct + kTables[i].wall, "");
    if (i < cards) add(kTables[i], kTables[i].card, "shadow_card = true\n");
  }
  return text;
}

void ExpectBulbHeld(const json& light) {
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(double(light["position_m"][k]), kBulb[k], double(light["position_u95_m"][k]));
  }
  EXPECT_LE(double(light["intensity_cd"]["low95"]), 500.0);
  EXPECT_GE(double(light["intensity_cd"]["high95"]), 500.0);
}

TEST(LocateInARoom, WhatTheWallsLeaveOpenIsRefusedAndCardsTellIt) {
  const TempDir folder;
  const std::string session = folder.Write("session.toml", BulbOverTables(0));
  const CliResult refused =
      RunLightcal({"fit", session, "-o", folder.path() + "/l.json", "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  const std::string message = json::parse(refused.out)["error"]["message"];
  EXPECT_NE(message.find("behind a shadow card"), std::string::npos) << message;
  folder.Write("session.toml", BulbOverTables(kTables.size()));
  const json light = LightcalJson("fit", {session, "-o", folder.path() + "/l.json"})["lights"][0];
  ExpectBulbHeld(light);
  for (const double u95 : light["position_u95_m"]) EXPECT_LT(u95, 0.08);
  EXPECT_LT(double(light["intensity_cd"]["u95"]), 60.0);
}

TEST(LocateInARoom, ThreeCardsTellTheWallsOfTheOtherPlaces) {
  const TempDir folder;
  const std::string session = folder.Write("session.toml", BulbOverTables(3));
  const json light = LightcalJson("fit", {session, "-o", folder.path() + "/l.json"})["lights"][0];
  ExpectBulbHeld(light);
  EXPECT_EQ(light["fit"]["used"], 10);
  EXPECT_EQ(light["fit"]["learned"], json({"intensity", "position", "room_bounce"}));
  const json& budget = light["budget"];
  EXPECT_TRUE(std::any_of(budget.begin(), budget.end(),
                          [](const json& part) { return part["name"] == "room_bounce"; }));
}

TEST(LocateInARoom, ADataSheetTellsHowFarOffTheLampIs) {
  const TempDir folder;
  const auto fit = [&](const std::string& sheet) {
    const std::string session = folder.Write("session.toml", BulbOverTables(1, sheet));
    return LightcalJson("fit", {session, "-o", folder.path() + "/l.json", "--force"});
  };
  const auto width = [](const json& value) {
    return std::log(double(value["high95"]) / double(value["low95"]));
  };
  const json readings = fit("")["lights"][0];
  // 500 cd of a bulb whose base takes 15 % of 4 pi.
  const json told = fit("flux_lm = 5340\n")["lights"][0];
  ExpectBulbHeld(readings);
  ExpectBulbHeld(told);
  EXPECT_LT(width(told["intensity_cd"]), 0.9 * width(readings["intensity_cd"]));
  EXPECT_LT(width(told["flux_lm"]), 0.8 * width(readings["flux_lm"]));
  EXPECT_LT(double(told["position_u95_m"][2]), 0.95 * double(readings["position_u95_m"][2]));
  // Of another lamp it is not heard, and that is said.
  const json other = fit("flux_lm = 53400\n");
  EXPECT_EQ(other["lights"][0]["intensity_cd"], readings["intensity_cd"]);
  EXPECT_TRUE(std::ranges::any_of(other["warnings"], [](const json& warning) {
    return warning["code"] == "data_sheet_disagrees";
  }));
}

TEST(LocateByProgram, ABulbMayShineUnevenlyAndAPointSaysThatItDoesNot) {
  // Twice as bright downwards as upwards: I = 900 (1 + .35 cos) from the base above.
  const Point lamp{0.3, -0.2, 1.6};
  std::string readings;
  for (const Point& at :
       {Point{1.3, 0.0, 0.4}, Point{-0.9, 0.1, 1.0}, Point{0.4, 1.0, 2.3}, Point{0.2, -1.4, 0.6},
        Point{1.1, 0.8, 1.9}, Point{-0.7, -0.9, 2.4}, Point{0.1, 0.4, 0.2}}) {
    const Point way = {lamp[0] - at[0], lamp[1] - at[1], lamp[2] - at[2]};
    const double r = std::hypot(way[0], way[1], way[2]);
    const auto triple = [](double x, double y, double z) {
      return "[" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + "]\n";
    };
    readings +=
        "[[reading]]\nlight = \"key\"\nmeter = \"m\"\nnormal = " +
        triple(way[0] / r, way[1] / r, way[2] / r) + "position_m = " + triple(at[0], at[1], at[2]) +
        "illuminance_lx = " + std::to_string(900.0 * (1.0 + 0.35 * way[2] / r) / (r * r)) + "\n";
  }
  const TempDir folder;
  const std::string session = folder.Write("session.toml", kLocatedHead + readings);
  const CliResult point = RunLightcal({"fit", session, "-o", folder.path() + "/p.json"});
  EXPECT_EQ(point.exit_code, 0) << point.err;
  EXPECT_NE(point.err.find("shines alike towards every meter"), std::string::npos) << point.err;
  const auto off = [&](const json& light) {
    return std::abs(double(light["position_m"][2]) - lamp[2]) / double(light["position_u95_m"][2]);
  };
  const json even = LightcalJson("fit", {session, "-o", folder.path() + "/p.json"})["lights"][0];
  EXPECT_GT(off(even), 1.5);
  folder.Write("session.toml", std::string(kLocatedHead)
                                       .replace(std::string(kLocatedHead).find("[[meter]]"), 0,
                                                "fixture = \"bulb\"\n") +
                                   readings);
  const json bulb = LightcalJson("fit", {session, "-o", folder.path() + "/b.json"})["lights"][0];
  EXPECT_LT(off(bulb), 1.0);
  const json& budget = bulb["budget"];
  EXPECT_TRUE(std::any_of(budget.begin(), budget.end(),
                          [](const json& part) { return part["name"] == "uneven_light"; }));
}

}  // namespace
}  // namespace lightcal::test
