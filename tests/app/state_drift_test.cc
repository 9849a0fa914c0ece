// SPDX-License-Identifier: Apache-2.0
// Lamps with controls that warm up while they are swept, and whose light starts elsewhere at every
// zoom: sessions worked out by hand, read back through the built command.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"
#include "session_of_states.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

std::string AtMinute(int minute) {
  return "time = \"2026-03-01T10:" + std::to_string(10 + minute) + ":00Z\"\n";
}

double Half(const json& u) {
  return u.contains("high95") ? double(u["high95"]) - double(u["value"]) : double(u["u95"]);
}

// Full, four others, full ... of a lamp that loses 8 % on the way.
const std::vector<std::pair<int, double>> kSweep = {
    {100, 1.0}, {25, .26}, {75, .76},  {12, .13}, {60, .62}, {100, 1.0}, {50, .52}, {5, .06},
    {90, .91},  {18, .2},  {100, 1.0}, {35, .37}, {8, .09},  {66, .67},  {42, .44}, {100, 1.0}};

TEST(StateCommand, ADriftSeenAtFullIsTakenOutOfEveryState) {
  const TempDir folder;
  std::string text = DarkSession();
  int minute = 0;
  for (const auto& [dimmer, part] : kSweep) {
    const double tired = 1.0 - 0.08 * minute / 15.0;
    text += StateRow(1.0, 1000.0 * part * tired, "dimmer = " + std::to_string(dimmer),
                     AtMinute(minute));
    ++minute;
  }
  folder.Write("lamp/session.toml", text);
  const json all = LightcalJson("state", {folder.path() + "/lamp"});
  std::map<int, double> truth(kSweep.begin(), kSweep.end());
  for (const json& state : all["lights"][0]["states"]) {
    const int dimmer = static_cast<int>(double(state["state"]["dimmer"]));
    const double part = truth.at(dimmer);
    const double found = state["relative_to_full"]["value"];
    // Over the mean of full this would be up to 4 % off.
    EXPECT_NEAR(found / part, 1.0, 0.006) << "dimmer " << dimmer;
    EXPECT_LE(std::abs(found - part), Half(state["relative_to_full"]) + 1e-12);
  }
}

TEST(StateCommand, ADriftBetweenFullBeforeAndFullAfterIsTakenOut) {
  const TempDir folder;
  std::string text = DarkSession();
  int minute = 0;
  const std::vector<std::pair<int, double>> sweep = {{100, 1.0}, {20, .055}, {75, .596}, {10, .016},
                                                     {50, .287}, {35, .151}, {100, 1.0}};
  for (const auto& [dimmer, part] : sweep) {
    text += StateRow(1.0, 5000.0 * part * (1.0 - 0.1 * minute / 6.0),
                     "dimmer = " + std::to_string(dimmer), AtMinute(minute));
    ++minute;
  }
  folder.Write("lamp/session.toml", text);
  const json all = LightcalJson("state", {folder.path() + "/lamp"});
  const std::map<int, double> truth(sweep.begin(), sweep.end());
  for (const json& state : all["lights"][0]["states"]) {
    const double part = truth.at(static_cast<int>(double(state["state"]["dimmer"])));
    const double found = state["relative_to_full"]["value"];
    // Over the mean of full this would be up to 5 % off.
    EXPECT_NEAR(found / part, 1.0, 0.01) << state["state"].dump();
  }
}

TEST(StateCommand, FullReadingsThatScatterWithoutTimesWidenEveryState) {
  const auto half_width = [](double second_full) {
    const TempDir folder;
    folder.Write("lamp/session.toml", DarkSession() + StateRow(1.0, 1000.0, "dimmer = 100") +
                                          StateRow(1.0, second_full, "dimmer = 100") +
                                          StateRow(1.0, 500.0, "dimmer = 50"));
    const json light = LightcalJson("fit", {folder.path() + "/lamp"})["lights"][0];
    const json& relative = light["states"][1]["relative"];
    return double(relative["u95"]) / double(relative["value"]);
  };
  EXPECT_LT(half_width(1001.0), 0.03);
  EXPECT_GT(half_width(1100.0), 0.08);
}

// 8000 cd from 15 cm behind the mark at 20 degrees, 1000 cd from 2 cm before it at 60.
std::string Zoomed() {
  std::string text = DarkSession();
  const auto add = [&](double zoom, double candela, double offset) {
    const std::string at = "zoom_deg = " + std::to_string(zoom);
    for (const double d : {0.7, 1.5, 3.0}) {
      text += StateRow(d, candela / std::pow(d + offset, 2.0), "dimmer = 100, " + at);
    }
    text += StateRow(1.5, 0.3 * candela / std::pow(1.5 + offset, 2.0), "dimmer = 25, " + at);
  };
  add(20.0, 8000.0, 0.15);
  add(60.0, 1000.0, -0.02);
  return text;
}

TEST(StateCommand, EachZoomStartsWhereItsOwnReadingsSay) {
  const TempDir folder;
  folder.Write("lamp/session.toml", Zoomed());
  const auto at = [&](const std::string& state) {
    return LightcalJson("state", {folder.path() + "/lamp", "--at", state});
  };
  const std::vector<std::pair<std::string, double>> truths = {{"dimmer=100,zoom_deg=20", 8000.0},
                                                              {"dimmer=25,zoom_deg=20", 2400.0},
                                                              {"dimmer=100,zoom_deg=60", 1000.0},
                                                              {"dimmer=25,zoom_deg=60", 300.0}};
  for (const auto& [state, candela] : truths) {
    const json answer = at(state);
    EXPECT_EQ(answer["basis"], "measured");
    // By the other zoom's offset it would be 20 % off at 1.5 m.
    EXPECT_NEAR(double(answer["intensity_cd"]["value"]) / candela, 1.0, 0.02) << state;
    EXPECT_EQ(answer.dump().find("state_geometry"), std::string::npos) << "its own is known";
  }
}

TEST(StateCommand, AZoomReadAtOneDistanceIsAsWideAsSuchFixturesDiffer) {
  const auto half = [](const std::string& fixture) {
    const TempDir folder;
    std::string text = DarkSession();
    const std::string kind = "kind = \"point\"\n";
    text.insert(text.find(kind) + kind.size(), "fixture = \"" + fixture + "\"\n");
    for (const double d : {0.7, 1.5, 3.0}) {
      text += StateRow(d, 8000.0 / (d * d), "dimmer = 100, zoom_deg = 20");
    }
    folder.Write("lamp/session.toml", text + StateRow(0.7, 1000.0, "dimmer = 100, zoom_deg = 60"));
    const json light = LightcalJson("fit", {folder.path() + "/lamp"});
    EXPECT_EQ(light["warnings"][0]["code"], "offset_shared") << light["warnings"];
    const json& relative = light["lights"][0]["states"][1]["relative"];
    return double(relative["u95"]) / double(relative["value"]);
  };
  EXPECT_GT(half("fresnel"), 1.5 * half("panel"));
}

}  // namespace
}  // namespace lightcal::test
