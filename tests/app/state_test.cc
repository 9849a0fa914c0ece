// SPDX-License-Identifier: Apache-2.0
// Lamps with controls, driven as a shell would: state, fit, export, diff, read and sweep. The truth
// of dimmed_panels is its own readings, worked out from published spectra.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"
#include "session_of_states.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string Panels() { return SampleData("sessions/dimmed_panels/session.toml"); }

// A point lamp of 1000 cd at full, 10 % of which its "5 %" gives, read in a dark room: at 1, 2 and
// 4 m at full, at 1 m dimmed.
std::string Lamp() {
  return DarkSession() + StateRow(1.0, 1000.0, "dimmer = 100") +
         StateRow(2.0, 250.0, "dimmer = 100") + StateRow(4.0, 62.5, "dimmer = 100") +
         StateRow(1.0, 545.0, "dimmer = 50") + StateRow(1.0, 307.5, "dimmer = 25") +
         StateRow(1.0, 147.0, "dimmer = 10") + StateRow(1.0, 100.0, "dimmer = 5");
}

TEST(StateCommand, EveryStateAnswersWithWhatWasRead) {
  const json all = LightcalJson("state", {Panels()});
  int states = 0;
  const json full = all["lights"][0]["states"][0];
  EXPECT_EQ(full["state"], json({{"dimmer", 100.0}, {"cct_K", 4000.0}}));
  EXPECT_NEAR(double(full["illuminance_lx"]["value"]), 9060.1, 90.6);
  EXPECT_NEAR(double(full["cct_K"]["value"]), 3562.7, 15.0);
  for (const json& light : all["lights"]) {
    for (const json& state : light["states"]) {
      ++states;
      EXPECT_EQ(state["basis"], "measured");
      EXPECT_GT(double(state["illuminance_lx"]["u95"]), 0.0);
    }
  }
  EXPECT_EQ(states, 21);
}

// Of one place and no dimmer: white, not red, which was read first.
TEST(StateCommand, ItsIntensityIsThatOfItsBrightestState) {
  const TempDir folder;
  const std::string session = folder.Write(
      "session.toml", DarkSession() + StateRow(2.0, 210.0, "red = 100, green = 0, white = 0") +
                          StateRow(2.0, 480.0, "red = 0, green = 100, white = 0") +
                          StateRow(2.0, 900.0, "red = 0, green = 0, white = 100"));
  const json light = LightcalJson("fit", {session})["lights"][0];
  EXPECT_NEAR(double(light["intensity_cd"]["value"]), 3600.0, 200.0);
}

// One warning a cause: three emitters that no white is near.
TEST(StateCommand, StatesThatHaveNoColourTemperatureAreNamedTogether) {
  const TempDir folder;
  const auto color = [](const std::string& xy) { return "xy = [" + xy + "]\n"; };
  const std::string session = folder.Write(
      "session.toml",
      DarkSession() + StateRow(2.0, 210.0, "red = 100, green = 0, white = 0", color("0.70, 0.30")) +
          StateRow(2.0, 480.0, "red = 0, green = 100, white = 0", color("0.17, 0.70")) +
          StateRow(2.0, 900.0, "red = 0, green = 0, white = 100", color("0.34, 0.35")));
  const json document = LightcalJson("fit", {session});
  const auto withheld = std::ranges::count(document["warnings"], "cct_withheld",
                                           [](const json& one) { return one["code"]; });
  EXPECT_EQ(withheld, 1) << document["warnings"];
  EXPECT_THAT(document["warnings"].dump(),
              HasSubstr("at green=0, red=100, white=0; green=100, red=0, white=0: no white"));
}

TEST(StateCommand, ALabelIsNotLight) {
  const json five =
      LightcalJson("state", {Panels(), "--light", "panel", "--at", "dimmer=5,cct_K=4000"});
  EXPECT_NEAR(double(five["relative_to_full"]["value"]), 907.06 / 9060.12, 0.001);
  EXPECT_DOUBLE_EQ(double(five["label"]["relative_to_full"]), 0.05);
  EXPECT_NEAR(double(five["cct_K"]["value"]), 3632.3, 15.0);
  EXPECT_EQ(double(five["label"]["cct_K"]), 4000.0);
  const CliResult told =
      RunLightcal({"state", Panels(), "--light", "panel", "--at", "dimmer=5,cct_K=4000"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("label 5.00 %, +1.0 stop"));
  EXPECT_THAT(told.out, HasSubstr("label 4000 K"));
}

TEST(StateCommand, StatesLeftOutAreFoundFromTheOthers) {
  const json all = LightcalJson("state", {Panels()});
  std::vector<double> errors;
  std::vector<double> widths;
  std::vector<double> kelvins;
  int held = 0;
  for (const json& light : all["lights"]) {
    for (const json& state : light["states"]) {
      if (!state.contains("left_out")) continue;
      const json& out = state["left_out"];
      errors.push_back(std::abs(double(out["relative_error"])));
      widths.push_back(double(out["u95_relative"]));
      kelvins.push_back(std::abs(double(out["cct_error_K"])));
      held += errors.back() <= widths.back() ? 1 : 0;
    }
  }
  ASSERT_EQ(errors.size(), 14U);
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return 0.5 * (values[6] + values[7]);
  };
  EXPECT_LE(median(errors), 0.01);
  EXPECT_LE(median(kelvins), 10.0);
  EXPECT_LE(median(widths), 0.05);  // a knee between the states left is in it
  EXPECT_GE(held, 13);
}

TEST(StateCommand, TwoStatesAreNotToldByEachOtherAndNothingIsSaidOfIt) {
  const TempDir folder;
  const std::string two =
      folder.Write("session.toml", DarkSession() + StateRow(1.0, 1000.0, "dimmer = 100") +
                                       StateRow(1.0, 147.0, "dimmer = 10"));
  const CliResult told = RunLightcal({"state", two});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, ::testing::Not(HasSubstr("left out")));
  EXPECT_THAT(RunLightcal({"state", Panels()}).out, HasSubstr("left out: what the other states"));
}

TEST(StateCommand, TwoColourTemperaturesAskForOneInTheMiddle) {
  const TempDir folder;
  const std::string ends =
      DarkSession() + StateRow(1.0, 1000.0, "cct_K = 2700") + StateRow(1.0, 1000.0, "cct_K = 6500");
  const std::string two = folder.Write("session.toml", ends);
  EXPECT_THAT(RunLightcal({"state", two, "--at", "cct_K=5000"}).out,
              HasSubstr("read one state near the middle, cct_K=4200"));
  const std::string three =
      folder.Write("three/session.toml", ends + StateRow(1.0, 1000.0, "cct_K = 4200"));
  EXPECT_THAT(RunLightcal({"state", three, "--at", "cct_K=5000"}).out,
              ::testing::Not(HasSubstr("near the middle")));
}

TEST(StateCommand, RefusesWhatWasNotReadRatherThanGuess) {
  const auto code = [](const std::string& at) {
    const CliResult run =
        RunLightcal({"state", Panels(), "--light", "panel", "--at", at, "--json"});
    EXPECT_EQ(run.exit_code, 3) << at;
    return json::parse(run.out)["error"]["code"];
  };
  EXPECT_EQ(code("dimmer=2,cct_K=4000"), "outside_states");
  EXPECT_EQ(code("dimmer=50,cct_K=6500"), "outside_states");
  EXPECT_EQ(code("dimmer=50"), "state_controls");
  const auto told = [](const std::string& at) {
    return RunLightcal({"state", Panels(), "--light", "panel", "--at", at}).err;
  };
  EXPECT_THAT(told("dimmer=50"), HasSubstr("dimmer=50 does not say cct_K"));
  EXPECT_THAT(told("dimmer=50,cct_K=4000,zoom_deg=20"), HasSubstr("says zoom_deg, which none"));
  const json combined =
      LightcalJson("state", {Panels(), "--light", "panel", "--at", "dimmer=12,cct_K=5000"});
  EXPECT_EQ(combined["basis"], "combined");
  EXPECT_EQ(combined["warnings"][0]["code"], "state_combined");
  EXPECT_EQ(RunLightcal({"state", Panels(), "--light", "panel", "--at", "dimmer"}).exit_code, 2);
}

TEST(StateCommand, OneIntensityIsFittedAndEachStateIsAPartOfIt) {
  const TempDir folder;
  folder.Write("lamp/session.toml", Lamp());
  const json fit = LightcalJson("fit", {folder.path() + "/lamp"});
  const json& light = fit["lights"][0];
  const double full = light["intensity_cd"]["value"];
  EXPECT_NEAR(full, 1000.0, 15.0) << "the dimmed readings are not in it";
  EXPECT_EQ(light["fit"]["readings"], 3);
  EXPECT_EQ(light["state"], json({{"dimmer", 100.0}}));
  ASSERT_EQ(light["states"].size(), 5U);
  const std::map<double, double> truth = {{100, 1.0}, {50, .545}, {25, .3075}, {10, .147}, {5, .1}};
  for (const json& state : light["states"]) {
    const double part = truth.at(double(state["state"]["dimmer"]));
    EXPECT_NEAR(double(state["relative"]["value"]), part, 1e-6 * part);
    EXPECT_NEAR(double(state["intensity_cd"]["value"]), part * full, 1e-6 * full);
    // The meter's scale is in the intensity and in no ratio.
    EXPECT_LT(double(state["relative"]["u95"]), 0.03 * part);
  }
  // Linear from 5.25 % up: 0.0525 + 0.95 x would be 0.3375 at 30 %; these readings lie on one line
  // within their repeatability.
  const json between = LightcalJson("state", {folder.path() + "/lamp", "--at", "dimmer=37"});
  EXPECT_EQ(between["basis"], "between");
  EXPECT_NEAR(double(between["relative_to_full"]["value"]), 0.4219, 0.012);
}

TEST(StateCommand, AmbientLightIsTakenFromEveryState) {
  const TempDir folder;
  std::string text = DarkSession();
  const auto add = [&](double lux, const std::string& state) {
    text += StateRow(1.0, lux + 20.0, state);
  };
  add(1000.0, "dimmer = 100");
  add(100.0, "dimmer = 10");
  text += StateRow(1.0, 20.0, "") + "lamp = \"off\"\n";
  folder.Write("lamp/session.toml", text);
  const json ten = LightcalJson("state", {folder.path() + "/lamp", "--at", "dimmer=10"});
  EXPECT_NEAR(double(ten["relative_to_full"]["value"]), 0.1, 1e-6);
}

TEST(StateCommand, AReadingThatDoesNotSayItsStateIsRefused) {
  const TempDir folder;
  folder.Write("lamp/session.toml", Lamp() + StateRow(3.0, 111.0, ""));
  const CliResult run = RunLightcal({"run", folder.path() + "/lamp", "--json"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(json::parse(run.out)["error"]["code"], "state_missing");
  folder.Write("other/session.toml", Lamp() + StateRow(3.0, 111.0, "dimmer = 50, tint = 1"));
  const CliResult other = RunLightcal({"fit", folder.path() + "/other", "--json"});
  EXPECT_EQ(json::parse(other.out)["error"]["code"], "state_controls");
}

TEST(StateCommand, WhatTheBoxSaysIsOfNoState) {
  const TempDir folder;
  const std::string session = folder.path() + "/panel";
  ASSERT_EQ(RunLightcal({"new", session, "--box", "60W 4000K", "--accuracy", "4%", "--room", "dark",
                         "--to", "blender", "--yes"})
                .exit_code,
            0);
  const CliResult swept = RunLightcal({"sweep", "-s", session, "--distance", "1m", "--typed",
                                       "--in-order", "--over", "dimmer=100,50,25,10", "--json"},
                                      "1000\n520\n280\n140\n1000\n");
  ASSERT_EQ(swept.exit_code, 0) << swept.out;
  const json half = LightcalJson("state", {session, "--at", "dimmer=50"});
  EXPECT_NEAR(double(half["relative_to_full"]["value"]), 0.52, 1e-6);
  // What would be read next is the reference, which the line says: else it would be refused.
  const std::string report = folder.path() + "/report.html";
  ASSERT_EQ(RunLightcal({"report", session, "-o", report}).exit_code, 0);
  EXPECT_THAT(ReadFile(report), HasSubstr("--state dimmer=100 --distance"));
}

TEST(StateCommand, ExportsALampAsItIsAtAState) {
  const TempDir folder;
  folder.Write("lamp/session.toml", Lamp());
  LightcalJson("fit", {folder.path() + "/lamp", "-o", folder.path() + "/light.json"});
  LightcalJson("export", {folder.path() + "/light.json", "--to", "json,gltf", "--state",
                          "dimmer=50", "-o", folder.path() + "/half"});
  const json preset = json::parse(ReadFile(folder.path() + "/half/light.preset.json"));
  const double half = preset["lights"][0]["photometry"]["intensity_cd"]["value"];
  EXPECT_NEAR(half, 545.0, 9.0);
  const json gltf = json::parse(ReadFile(folder.path() + "/half/light.gltf"));
  EXPECT_NEAR(double(gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"]), half,
              1e-3 * half);
  const CliResult none = RunLightcal({"export", folder.path() + "/light.json", "--state",
                                      "dimmer=1", "-o", folder.path() + "/none", "--json"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(json::parse(none.out)["error"]["code"], "outside_states");
}

// A file of the lamp at half is held against what was read at half.
TEST(StateCommand, APresetOfAStateIsCheckedAgainstThatState) {
  const TempDir folder;
  folder.Write("session.toml", Lamp());
  const std::string out = folder.path() + "/presets";
  ASSERT_EQ(RunLightcal({"run", folder.path(), "--to", "json"}).exit_code, 0);
  ASSERT_EQ(RunLightcal({"export", folder.path() + "/out/light.json", "--to", "gltf", "--state",
                         "dimmer=50", "-o", out})
                .exit_code,
            0);
  const std::vector<std::string> words = {"check", out + "/light.gltf", "--session", folder.path()};
  const CliResult other = RunLightcal(words);
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("--state"));
  const auto at = [&](const std::string& state) {
    std::vector<std::string> more = words;
    more.insert(more.end(), {"--state", state, "--json"});
    return RunLightcal(more);
  };
  const CliResult half = at("key:dimmer=50");
  EXPECT_EQ(half.exit_code, 0) << half.err;
  const json answer = json::parse(half.out);
  ASSERT_EQ(answer["readings"].size(), 1U);
  EXPECT_NEAR(double(answer["readings"][0]["measured_lx"]), 545.0, 1.0);
  EXPECT_LT(double(answer["rms_relative"]), 0.01);
  const CliResult quarter = at("dimmer=25");
  EXPECT_EQ(quarter.exit_code, 1) << "545 lx for 307.5";
  const CliResult unread = at("dimmer=40");
  EXPECT_EQ(unread.exit_code, 3);
  EXPECT_THAT(unread.err, HasSubstr("dimmer=50"));
}

TEST(StateCommand, WhatIsTakenBackIsTheJournalsLastOfAnyState) {
  const TempDir folder;
  folder.Write("session.toml", DarkSession());
  for (const auto& [state, lux] :
       {std::pair("dimmer=100", "1000"), {"dimmer=50", "400"}, {"dimmer=25", "170"}}) {
    ASSERT_EQ(RunLightcal({"read", "-s", folder.path(), "--light", "key", "--distance", "1m",
                           "--lux", lux, "--state", state})
                  .exit_code,
              0);
  }
  const json first = LightcalJson("read", {"-s", folder.path(), "--undo"});
  EXPECT_EQ(first["took_back"], "readings.jsonl:3");
  EXPECT_EQ(first["reading"]["illuminance_lx"], 170.0);
  EXPECT_EQ(LightcalJson("read", {"-s", folder.path(), "--undo"})["took_back"], "readings.jsonl:2");
}

TEST(StateCommand, DiffNamesTheStateThatChanged) {
  const TempDir folder;
  folder.Write("a/session.toml", Lamp());
  std::string later = Lamp();
  const std::string was = StateRow(1.0, 307.5, "dimmer = 25");
  later.replace(later.find(was), was.size(), StateRow(1.0, 250.0, "dimmer = 25"));
  folder.Write("b/session.toml", later);
  for (const char* one : {"a", "b"}) LightcalJson("fit", {folder.path() + "/" + one});
  const json diff = LightcalJson("diff", {folder.path() + "/a", folder.path() + "/b"});
  int changed = 0;
  for (const json& quantity : diff["lights"][0]["quantities"]) {
    if (quantity["verdict"] != "changed") continue;
    ++changed;
    EXPECT_EQ(quantity["quantity"], "states[dimmer=25].intensity_cd");
  }
  EXPECT_EQ(changed, 1);
}

TEST(StateCommand, ReadAndImportSayStates) {
  const TempDir folder;
  folder.Write("lamp/session.toml", DarkSession());
  const std::string session = folder.path() + "/lamp";
  const auto read = [&](const std::string& lux, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"read",       "-s", session, "--light", "key",
                                      "--distance", "1m", "--lux", lux};
    words.insert(words.end(), more.begin(), more.end());
    return RunLightcal(words);
  };
  EXPECT_EQ(read("1000", {"--state", "dimmer=100%"}).exit_code, 0);
  EXPECT_EQ(read("500", {}).exit_code, 3) << "a state is missing";
  EXPECT_EQ(read("500", {"--state", "dimmer=120"}).exit_code, 2);
  const std::string csv =
      folder.Write("sweep.csv", "distance_m,illuminance_lx,state.dimmer\n1,545,50\n1,307.5,25\n");
  const CliResult imported = RunLightcal({"import", csv, "-s", session, "--light", "key"});
  EXPECT_EQ(imported.exit_code, 0) << imported.err;
  const json half = LightcalJson("state", {session, "--at", "dimmer=50"});
  EXPECT_NEAR(double(half["relative_to_full"]["value"]), 0.545, 1e-6);
  // Imported again, nothing is added.
  RunLightcal({"import", csv, "-s", session, "--light", "key"});
  const std::string journal = ReadFile(session + "/readings.jsonl");
  EXPECT_EQ(std::ranges::count(journal, '\n'), 3);
}

TEST(SweepCommand, GoesOnWhereItStopped) {
  const TempDir folder;
  folder.Write("lamp/session.toml", DarkSession());
  const std::string session = folder.path() + "/lamp";
  const std::vector<std::string> words = {
      "sweep",   "-s",         session,  "--distance",       "1m",
      "--typed", "--in-order", "--over", "dimmer=100,50,25", "--json"};
  // Two numbers, then nobody types any more.
  json told = json::parse(RunLightcal(words, "1000\n545\n").out);
  EXPECT_EQ(told["taken"], 2);
  EXPECT_EQ(told["left"], 2);
  told = json::parse(RunLightcal(words, "307.5\n999\n").out);
  EXPECT_EQ(told["held"], 2);
  EXPECT_EQ(told["left"], 0);
  EXPECT_EQ(json::parse(RunLightcal(words, "1\n").out)["taken"], 0) << "all was read";
  const json quarter = LightcalJson("state", {session, "--at", "dimmer=25"});
  EXPECT_NEAR(double(quarter["relative_to_full"]["value"]), 0.3075, 0.001);
}

TEST(SweepCommand, ReadsOnlyUntilItIsSure) {
  const TempDir folder;
  folder.Write("lamp/session.toml", DarkSession());
  std::string typed;
  // In the order it asks for: the ends, then where it is least sure; a linear driver answers.
  const std::vector<std::string> words = {"sweep",
                                          "-s",
                                          folder.path() + "/lamp",
                                          "--distance",
                                          "1m",
                                          "--typed",
                                          "--until",
                                          "6%",
                                          "--over",
                                          "dimmer=100,90,80,70,60,50,40,30,20,10"};
  for (int round = 0; round < 10; ++round) {
    const CliResult asked = RunLightcal(words, "");
    const std::size_t at = asked.err.rfind("set dimmer=");
    if (at == std::string::npos) break;
    const double dimmer = std::stod(asked.err.substr(at + 11));
    RunLightcal(words, std::to_string(1000.0 * (0.04 + 0.0096 * dimmer)) + "\n");
  }
  const std::string journal = ReadFile(folder.path() + "/lamp/readings.jsonl");
  EXPECT_LE(std::ranges::count(journal, '\n'), 6) << "of the even grid's ten";
  const json there = LightcalJson("state", {folder.path() + "/lamp", "--at", "dimmer=15"});
  EXPECT_NEAR(double(there["relative_to_full"]["value"]), 0.184, 0.06 * 0.184);
}

}  // namespace
}  // namespace lightcal::test
