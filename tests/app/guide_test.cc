// SPDX-License-Identifier: Apache-2.0
// From an empty folder to presets on a terminal, as its transcript: new, read (guided, typed and by
// a simulated USB meter), run, export. Nothing is edited by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "run_cli.h"
#include "terminal_dialogue.h"
#include "usb_stand_in.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// A lamp in a room that adds the same light everywhere.
struct LampInRoom {
  double candela = 80.0;
  double offset_m = 0.03;  // behind the point distances are measured from
  double other_lx = 2.0;
  [[nodiscard]] double Lux(double distance_m, bool card) const {
    const double r = distance_m + offset_m;
    return (card ? 0.0 : candela / (r * r)) + other_lx;
  }
};

// What a step of the walk asks for.
struct Step {
  double distance_m = 0.0;
  bool card = false;
};
Step StepIn(const std::string& text) {
  static const std::regex kPlace(
      "(Put the meter|Leave the meter at) ([0-9.]+) m( from the lamp|\\. Hold the card)");
  std::smatch found;
  EXPECT_TRUE(std::regex_search(text, found, kPlace)) << text;
  return found.empty() ? Step{} : Step{std::stod(found[2]), found[1] != "Put the meter"};
}

constexpr const char* kPromptEnd = "q = stop";

// Does what the walk says until it ends; how many readings were asked for.
template <class Answer>
int Follow(TerminalDialogue& walk, Answer answer) {
  int steps = 0;
  while (const auto text = walk.WaitFor(kPromptEnd)) {
    if (++steps > 30) break;
    answer(StepIn(*text));
  }
  return steps;
}

// The command that the screen says comes next, in words, without "lightcal".
std::vector<std::string> NextCommand(const std::string& transcript, const std::string& name) {
  const auto at = transcript.find("  lightcal " + name);
  EXPECT_NE(at, std::string::npos) << transcript;
  if (at == std::string::npos) return {};
  std::istringstream line(transcript.substr(at, transcript.find('\r', at) - at));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  words.erase(words.begin());
  return words;
}

std::vector<json> RowsOf(const std::string& journal) {
  std::vector<json> rows;
  std::istringstream lines(ReadFile(journal));
  for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
  return rows;
}

int RunIn(const std::string& folder, const std::vector<std::string>& arguments) {
  TerminalDialogue run(arguments, folder);
  const int code = run.Finish();
  EXPECT_EQ(code, 0) << run.transcript();
  return code;
}

// `most`: relative; what is left of the room where the meter alone is most of the interval.
void ExpectTheLampInTheEngines(const std::string& folder, const LampInRoom& truth,
                               double most = 0.02) {
  const json light = json::parse(ReadFile(folder + "/desk_lamp/out/light.json"))["lights"][0];
  const double candela = light["intensity_cd"]["value"];
  EXPECT_NEAR(candela, truth.candela, double(light["intensity_cd"]["u95"]));
  EXPECT_NEAR(candela, truth.candela, most * truth.candela);
  EXPECT_LT(double(light["intensity_cd"]["u95"]), 0.13 * candela);
  EXPECT_TRUE(fs::exists(folder + "/desk_lamp/out/report.html"));
  EXPECT_TRUE(fs::exists(folder + "/desk_lamp/out/desk_lamp.gltf"));
  EXPECT_TRUE(fs::exists(folder + "/desk_lamp/out/desk_lamp.blender.py"));
  EXPECT_FALSE(fs::exists(folder + "/desk_lamp/out/desk_lamp.usda")) << "was not asked for";
  RunIn(folder, {"export", "desk_lamp/out/light.json", "--to", "godot,json", "-o", "presets"});
  EXPECT_TRUE(fs::exists(folder + "/presets/light.tscn"));
  const json preset = json::parse(ReadFile(folder + "/presets/light.preset.json"));
  EXPECT_THAT(preset.dump(), HasSubstr("desk"));
}

// What quick, run, plan and the walk say comes next is one step.
TEST(GuidedSession, AsksForTheStepThatQuickRunAndPlanName) {
  const NoUsb machine;
  const TempDir home;
  home.Write("lamp/session.toml",
             "lightcal = 1\n[[light]]\nname = \"bulb\"\nkind = \"point\"\nfixture = \"bulb\"\n"
             "[[meter]]\nname = \"m\"\nsigma_relative = 0.025\n");
  std::string readings;
  for (const auto& [distance, lux] : {std::pair("0.5", "203"), std::pair("1", "58")}) {
    readings += std::string("[[reading]]\nlight = \"bulb\"\nmeter = \"m\"\ndistance_m = ") +
                distance + "\nilluminance_lx = " + lux + "\n";
    home.Write("lamp/session.toml",
               "lightcal = 1\n[[light]]\nname = \"bulb\"\nkind = \"point\"\nfixture = \"bulb\"\n"
               "[[meter]]\nname = \"m\"\nsigma_relative = 0.025\n" +
                   readings);
    const std::string lamp = home.path() + "/lamp";
    const CliResult plan = RunLightcal({"plan", lamp, "--json", "-q"});
    const std::string next = json::parse(plan.out)["lights"][0]["next"];
    std::smatch found;
    ASSERT_TRUE(std::regex_search(next, found, std::regex("at ([0-9.]+) m"))) << next;
    const bool card = next.find("shadow-card") != std::string::npos;
    const double at = std::stod(found[1]);
    TerminalDialogue walk({"read", "-s", "lamp", "--light", "bulb", "--guided", "--typed"},
                          home.path());
    const auto asked = walk.WaitFor(kPromptEnd);
    ASSERT_TRUE(asked) << walk.transcript();
    const Step step = StepIn(*asked);
    EXPECT_EQ(step.card, card) << next << "\n" << *asked;
    EXPECT_NEAR(step.distance_m, at, 1e-6) << next << "\n" << *asked;
    walk.Type("q");
    walk.Finish();
    std::ostringstream place;
    place << at << " m";
    const CliResult run = RunLightcal({"run", lamp, "-o", home.path() + "/out"});
    EXPECT_THAT(run.out, HasSubstr(place.str())) << next;
    EXPECT_THAT(run.out, HasSubstr(card ? "with a card" : "read at")) << next;
  }
}

TEST(GuidedSession, FromNothingToPresetsWithATypedMeter) {
  const NoUsb machine;
  const TempDir home;
  const LampInRoom truth;
  TerminalDialogue begin({"new"}, home.path());
  const std::vector<std::pair<std::string, std::string>> answers = {
      {"folder", "desk_lamp"},
      {"call the lamp", "desk"},
      {"What is it?", "buld"},
      {"none of these", "1"},
      {"How is it built?", "bulb"},
      {"box", "9W 806 lm"},
      {"watts, lumens, kelvin", "9W 806lm 2900K"},
      {"Which meter?", ""},
      {"data sheet says", "3%"},
      {"Which engines", "gltf,blnder"},
      {"blender", "gltf,blender"},
      {"width, depth", ""}};
  for (const auto& [prompt, typed] : answers) {
    ASSERT_TRUE(begin.WaitFor(prompt)) << prompt << "\n" << begin.transcript();
    ASSERT_TRUE(begin.WaitFor("] ")) << begin.transcript();
    begin.Type(typed);
  }
  ASSERT_EQ(begin.Finish(), 0) << begin.transcript();
  EXPECT_THAT(begin.transcript(), HasSubstr("half way"));  // the drawing

  TerminalDialogue walk(NextCommand(begin.transcript(), "read"), home.path());
  const int steps = Follow(walk, [&](const Step& step) {
    std::ostringstream shown;
    shown << truth.Lux(step.distance_m, step.card) << "lx";
    walk.Type(shown.str());
  });
  ASSERT_EQ(walk.Finish(), 0) << walk.transcript();
  EXPECT_THAT(walk.transcript(), HasSubstr("nough"));
  const auto rows = RowsOf(home.path() + "/desk_lamp/readings.jsonl");
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(steps));
  EXPECT_GE(steps, 4) << "two distances and their cards\n" << walk.transcript();
  EXPECT_LE(steps, 12) << walk.transcript();
  EXPECT_EQ(rows[1]["shadow_card"], true);
  EXPECT_EQ(rows[0]["meter"], "my_meter");
  RunIn(home.path(), NextCommand(begin.transcript(), "run"));
  ExpectTheLampInTheEngines(home.path(), truth);
}

// What the fit warns of is told while the meter is still in its place, and a slip of the finger is
// taken back without leaving.
TEST(GuidedSession, TheFitsDoubtsAreToldAndASlipIsTakenBack) {
  const NoUsb machine;
  const TempDir home;
  home.Write("s/session.toml",
             "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
             "fixture = \"bulb\"\n[[meter]]\nname = \"m\"\nsigma_relative = 0.02\n");
  const CliResult walked =
      RunProgram({LIGHTCAL_BINARY, "read", "-s", home.path() + "/s", "--guided", "--typed",
                  "--no-shadow-card"},
                 // 100 cd, a digit too many, another lamp's colour, a distance said 60 cm wrong.
                 "400,3200K@0.5m\n999@1m\nk\nu\n100,5600K@1m\n25@2.6m\nk\nq\n");
  EXPECT_EQ(walked.exit_code, 0) << walked.err;
  EXPECT_THAT(walked.err, HasSubstr("took the last reading back: key 999.0 lx at 1.000 m")) << walked.out;
  EXPECT_THAT(walked.err, HasSubstr("   note: its colours")) << walked.out;
  const auto rows = RowsOf(home.path() + "/s/readings.jsonl");
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[2]["undo"], 2) << "the line of the slip";
  EXPECT_THAT(walked.err, HasSubstr("2.600 m) alone asks for a distance offset"));
  EXPECT_THAT(walked.out + walked.err, HasSubstr("key: 100 cd"));
  const CliResult validated = RunLightcal({"validate", home.path() + "/s"});
  EXPECT_THAT(validated.out, HasSubstr("3 readings"));
}

SekonicSetting Sekonic() {
  SekonicSetting setting;
  setting.measurement = RecordedReply(kReply407lx);
  setting.busy_polls_after = 1;
  return setting;
}

TEST(GuidedSession, FromNothingToPresetsWithAMeterOnAUsbCable) {
  UsbStandIn meter(Sekonic(), {.serial = "J0123"});
  const TempDir home;
  const LampInRoom truth;
  const CliResult begun = RunLightcal({"new", home.path() + "/desk_lamp", "--lamp", "desk",
                                       "--kind", "point", "--to", "gltf,blender", "--yes"});
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_THAT(begun.out, HasSubstr("--device sekonic:J0123")) << "the only meter there is";

  TerminalDialogue walk({"read", "-s", "desk_lamp", "--device", "sekonic:J0123", "-n", "1"},
                        home.path());
  constexpr std::size_t kIlluminanceAt = 271;
  Follow(walk, [&](const Step& step) {
    const auto lux = static_cast<float>(truth.Lux(step.distance_m, step.card));
    meter.Show(WithFloat(RecordedReply(kReply407lx), kIlluminanceAt, lux));
    walk.Type("");
  });
  ASSERT_EQ(walk.Finish(), 0) << walk.transcript();
  EXPECT_THAT(walk.transcript(), HasSubstr("4995 K"));
  EXPECT_FALSE(meter.remote());
  RunIn(home.path(), {"run", "desk_lamp", "--to", "gltf,blender"});
  // A third of the meter's own 1 sigma of 5 %: the walk stops where no step is worth its minutes.
  ExpectTheLampInTheEngines(home.path(), truth, 0.03);
}

TEST(GuidedSession, WrongAnswersAreExplainedAndAskedAgain) {
  const NoUsb machine;
  const TempDir home;
  home.Write("s/session.toml",
             "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\n");
  TerminalDialogue walk({"read", "-s", "s"}, home.path());
  const LampInRoom truth;
  ASSERT_TRUE(walk.WaitFor(kPromptEnd)) << walk.transcript();
  walk.Type("bright");
  ASSERT_TRUE(walk.WaitFor(kPromptEnd)) << walk.transcript();
  walk.Type("-3m");
  ASSERT_TRUE(walk.WaitFor("above zero")) << walk.transcript();
  ASSERT_TRUE(walk.WaitFor(kPromptEnd));
  walk.Type("0.8m");
  ASSERT_TRUE(walk.WaitFor("at 0.8 m")) << walk.transcript();
  ASSERT_TRUE(walk.WaitFor(kPromptEnd));
  walk.Type(std::to_string(truth.Lux(0.8, false)));
  ASSERT_TRUE(walk.WaitFor("Hold the card")) << walk.transcript();
  ASSERT_TRUE(walk.WaitFor(kPromptEnd));
  walk.Type("500");  // the card did nothing
  ASSERT_TRUE(walk.WaitFor("keep it all the same")) << walk.transcript();
  walk.Type("");
  ASSERT_TRUE(walk.WaitFor("Hold the card")) << walk.transcript();
  ASSERT_TRUE(walk.WaitFor(kPromptEnd));
  walk.Type("2lx");
  ASSERT_TRUE(walk.WaitFor("came from elsewhere")) << walk.transcript();
  ASSERT_TRUE(walk.WaitFor(kPromptEnd));
  walk.Type("q");
  EXPECT_EQ(walk.Finish(), 0) << walk.transcript();
  const auto rows = RowsOf(home.path() + "/s/readings.jsonl");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["distance_m"], 0.8);
  EXPECT_EQ(rows[1]["distance_m"], 0.8);
  EXPECT_EQ(rows[1]["illuminance_lx"], 2.0);
}

TEST(GuidedSession, CtrlCAndCtrlDEndItAndKeepWhatWasRead) {
  const NoUsb machine;
  for (const char key : {'\x03', '\x04'}) {
    const TempDir home;
    home.Write("s/session.toml",
               "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\n");
    TerminalDialogue walk({"read", "-s", "s"}, home.path());
    ASSERT_TRUE(walk.WaitFor(kPromptEnd)) << walk.transcript();
    walk.Type("192");
    ASSERT_TRUE(walk.WaitFor("Hold the card")) << walk.transcript();
    ASSERT_TRUE(walk.WaitFor(kPromptEnd));
    walk.Press(key);
    EXPECT_EQ(walk.Finish(), key == '\x03' ? 1 : 0) << walk.transcript();
    EXPECT_THAT(walk.transcript(), HasSubstr("topped by you"));
    EXPECT_EQ(RowsOf(home.path() + "/s/readings.jsonl").size(), 1U);
  }
}

TEST(GuidedSession, WithoutATerminalItAnswersFromItsInputAndEndsWithIt) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  home.Write("s/session.toml",
             "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\n");
  const CliResult none = RunLightcal({"read", "-s", session, "--light", "key"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("--guided"));
  const CliResult piped =
      RunLightcal({"read", "-s", session, "--guided", "--typed", "--json"}, "100lx@1m\n1lx\n");
  ASSERT_EQ(piped.exit_code, 0) << piped.err;
  const json answer = json::parse(piped.out);
  EXPECT_EQ(answer["readings_taken"], 2);
  EXPECT_EQ(answer["ended"], "stopped");
  EXPECT_NEAR(double(answer["intensity_cd"]["value"]), 99.0, 1.0);
}

TEST(GuidedSession, WhatTheMeterCannotReachIsSaidBeforeTheFirstReading) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  ASSERT_EQ(RunLightcal({"new", session, "--yes", "--kind", "point", "--accuracy", "3%"}).exit_code,
            0);
  const auto told = [&](const char* until) {
    return RunLightcal({"read", "-s", session, "--guided", "--typed", "--until", until}, "q\n").err;
  };
  EXPECT_THAT(told("3%"), HasSubstr("own accuracy leaves ± 3.0 % however often it reads"));
  EXPECT_THAT(told("2%"), HasSubstr("own accuracy leaves ± 3.0 %"));
  EXPECT_THAT(told("4%"), Not(HasSubstr("however often it reads")));
}

}  // namespace
}  // namespace lightcal::test
