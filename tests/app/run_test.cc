// SPDX-License-Identifier: Apache-2.0
// lightcal run and fit on real published lamps, driven as a shell would.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json RunJson(const std::string& session, const std::string& out) {
  return LightcalJson("run", {session, "-o", out});
}

struct Expectation {
  const char* session;
  double rms_at_most;
  int sign_of_offset;
};
class FilmLight : public ::testing::TestWithParam<Expectation> {};

// E d^2 as a person would compute it by hand, from the residual rows' own measured lux.
double SpreadOfEdd(const json& light) {
  double low = INFINITY;
  double high = 0.0;
  for (const json& row : light["residuals"]) {
    const double d = row["distance_m"];
    const double edd = double(row["measured_lx"]) * d * d;
    low = std::min(low, edd);
    high = std::max(high, edd);
  }
  return high / low - 1.0;
}

TEST_P(FilmLight, TheOffsetExplainsWhatInverseSquareCannot) {
  const TempDir out;
  const json document =
      RunJson(SampleData(std::string("sessions/") + GetParam().session), out.path());
  ASSERT_EQ(document["lights"].size(), 5U);
  double lowest_d0 = INFINITY;
  double highest_d0 = -INFINITY;
  double smallest_u95 = INFINITY;
  for (const json& light : document["lights"]) {
    SCOPED_TRACE(light["name"]);
    EXPECT_GT(SpreadOfEdd(light), 0.05);
    EXPECT_LE(double(light["fit"]["rms_relative"]), GetParam().rms_at_most);
    EXPECT_GE(int(light["fit"]["degrees_of_freedom"]), 1);
    EXPECT_TRUE(light["fit"].contains("leave_one_out"));
    const json& learned = light["fit"]["learned"];
    EXPECT_NE(std::ranges::find(learned, "distance_offset"), learned.end());
    const double d0 = light["distance_offset_m"]["value"];
    EXPECT_GT(d0 * GetParam().sign_of_offset, 0.0);
    lowest_d0 = std::min(lowest_d0, d0);
    highest_d0 = std::max(highest_d0, d0);
    smallest_u95 = std::min(smallest_u95, double(light["distance_offset_m"]["u95"]));
  }
  EXPECT_LT(highest_d0 - lowest_d0, smallest_u95) << "one optic, one offset";
}

INSTANTIATE_TEST_SUITE_P(Amaran200xS, FilmLight,
                         ::testing::Values(Expectation{"amaran_200x_s_bare", 0.025, +1},
                                           Expectation{"amaran_200x_s_hyper_reflector", 0.005, -1}),
                         [](const auto& film_light) {
                           return std::string(film_light.param.session);
                         });

TEST(RunCommand, WritesLightPresetsAndReportAndIsIdempotent) {
  const TempDir out;
  const std::string session = SampleData("sessions/three_real_lights");
  const json document = RunJson(session, out.path());
  for (const char* name :
       {"light.json", "report.html", "three_real_lights.gltf", "three_real_lights.preset.json"}) {
    EXPECT_TRUE(fs::exists(fs::path(out.path()) / name)) << name;
  }
  EXPECT_EQ(document["lights"].size(), 3U);
  EXPECT_GE(document["files"].size(), 16U) << "and an .ies and an .ldt for each of two lamps";
  const std::string first = ReadFile(out.path() + "/three_real_lights.gltf");
  RunJson(session, out.path());
  EXPECT_EQ(ReadFile(out.path() + "/three_real_lights.gltf"), first);
  for (const auto& entry : fs::directory_iterator(out.path())) {
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
    EXPECT_EQ(ReadFile(entry.path().string()).find("NaN"), std::string::npos);
  }
}

// Knobs of a lamp's dimmer and colour too.
TEST(RunCommand, PresetsAreThoseThatExportMakesOfTheLightFile) {
  const TempDir dir;
  const std::string out = dir.path() + "/run";
  ASSERT_EQ(RunLightcal(
                {"run", SampleData("sessions/dimmed_panels"), "--to", "blender,unreal", "-o", out})
                .exit_code,
            0);
  const std::string light = dir.Write("dimmed_panels.json", ReadFile(out + "/light.json"));
  ASSERT_EQ(RunLightcal({"export", light, "--to", "blender,unreal", "-o", dir.path() + "/export"})
                .exit_code,
            0);
  for (const std::string name : {"/dimmed_panels.blender.py", "/dimmed_panels.unreal.py"}) {
    const std::string script = ReadFile(out + name);
    EXPECT_THAT(script, testing::HasSubstr("\"controls\""));
    EXPECT_EQ(script, ReadFile(dir.path() + "/export" + name));
  }
}

// A farm types sessions/*/, a person session: one page of both (the Slurm bench found the slash).
TEST(RunCommand, HowAPathWasTypedIsInNoFile) {
  const TempDir dir;
  for (const char* sample : {"grey_card_exr", "three_real_lights"}) {
    const std::string copy = dir.path() + "/" + sample;
    std::filesystem::copy(SampleData(std::string("sessions/") + sample), copy,
                          std::filesystem::copy_options::recursive);
    std::vector<std::string> pages;
    for (const std::string& typed : {copy, copy + "/", copy + "/../" + sample}) {
      const std::string out = dir.path() + "/out" + std::to_string(pages.size()) + sample;
      ASSERT_EQ(RunLightcal({"run", typed, "-o", out}).exit_code, 0);
      pages.push_back(ReadFile(out + "/report.html"));
    }
    EXPECT_EQ(pages[0], pages[1]) << sample;
    EXPECT_EQ(pages[0], pages[2]) << sample;
    EXPECT_EQ(pages[0].find(dir.path()), std::string::npos) << sample;
  }
}

TEST(RunCommand, TheSpectrumsLampHasItsColorAndLuxButNoCandela) {
  const TempDir out;
  const json document = RunJson(SampleData("sessions/three_real_lights"), out.path());
  const json& led = document["lights"][2];
  EXPECT_EQ(led["kind"], "directional");
  EXPECT_FALSE(led.contains("intensity_cd"));
  EXPECT_NEAR(double(led["illuminance_lx"]["value"]), 7554.53125, 7.5);  // the file's own header
  EXPECT_NEAR(double(led["color"]["cct_K"]["value"]), 4988.0, 3.0);
  EXPECT_NEAR(double(led["color"]["duv"]), 0.001372, 1e-4);
}

TEST(RunCommand, TheTableNamesUnitsUncertaintyAndLearnedOrPrior) {
  const TempDir out;
  const CliResult result =
      RunLightcal({"run", SampleData("sessions/three_real_lights"), "-o", out.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* word : {"cob_bare", " cd ", " … ", "± ", "stops", " K"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  }
  const CliResult verbose =
      RunLightcal({"run", SampleData("sessions/three_real_lights"), "-o", out.path(), "--verbose"});
  for (const char* word : {" cd ± ", "learned", "dof", "leave-one-out", "rms"}) {
    EXPECT_NE(verbose.out.find(word), std::string::npos) << word << "\n" << verbose.out;
  }
}

TEST(RunCommand, NeverReplacesWhatItDidNotWrite) {
  const TempDir out;
  out.Write("report.html", "my holiday pictures");
  const std::string session = SampleData("sessions/three_real_lights");
  const CliResult refused = RunLightcal({"run", session, "-o", out.path()});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(ReadFile(out.path() + "/report.html"), "my holiday pictures");
  EXPECT_FALSE(fs::exists(out.path() + "/light.json"));
  EXPECT_EQ(RunLightcal({"run", session, "-o", out.path(), "--force"}).exit_code, 0);
}

TEST(RunCommand, FullAnglesOnRequestAreHalvedOnce) {
  const TempDir dir;
  const auto session = [&dir](const std::string& name, int inner, int outer) {
    return dir.Write(
        name, "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"spot\"\ninner_deg = " +
                  std::to_string(inner) + "\nouter_deg = " + std::to_string(outer) +
                  "\n[[reading]]\nlight = \"key\"\ndistance_m = 2\n" + "illuminance_lx = 400\n");
  };
  const json half =
      LightcalJson("fit", {session("half.toml", 20, 35), "-o", dir.path() + "/a.json"});
  const json full = LightcalJson(
      "fit", {session("full.toml", 40, 70), "-o", dir.path() + "/b.json", "--full-angles"});
  EXPECT_EQ(full["lights"], half["lights"]);
  EXPECT_NEAR(double(full["lights"][0]["cone"]["outer_deg"]), 35.0, 1e-9);
}

TEST(RunCommand, PresetsNameTheInstrumentsAndHowTheLampHangs) {
  const TempDir dir;
  const std::string session = dir.Write("session.toml", R"(lightcal = 1
name = "Tube"
[[light]]
name = "tube"
kind = "tube"
position_m = [0, 0, 2]
aim = [0, -1, 0]
axis = [0, 0, 1]
length_m = 1.2
radius_m = 0.013
)");
  dir.Write("readings.jsonl",
            R"({"light":"tube","distance_m":2.0,"illuminance_lx":25,"device":"sekonic:JN1-01"}
{"light":"tube","distance_m":3.0,"illuminance_lx":11.1,"device":"sekonic:JN1-01"}
)");
  const json document = RunJson(dir.path(), dir.path() + "/out");
  const json devices = {"sekonic:JN1-01"};
  const json upright = {0.0, 0.0, 1.0};
  EXPECT_EQ(document["provenance"]["devices"], devices);
  EXPECT_EQ(document["lights"][0]["axis"], upright);
  std::string preset;
  for (const auto& entry : fs::directory_iterator(dir.path() + "/out")) {
    if (entry.path().string().ends_with(".preset.json")) preset = ReadFile(entry.path().string());
  }
  const json written = json::parse(preset, nullptr, false);
  ASSERT_TRUE(written.is_object()) << preset;
  EXPECT_EQ(written["provenance"]["devices"], devices);
  EXPECT_EQ(written["lights"][0]["geometry"]["axis"], upright);
}

TEST(FitCommand, WarnsOfPlacesOutsideTheRoom) {
  const TempDir dir;
  const auto warned = [&](const std::string& place, const char* lux) {
    const std::string session = dir.Write("session.toml", R"(lightcal = 1
name = "Room"
[room]
size_m = [5, 4, 2.6]
[[light]]
name = "key"
kind = "point"
position_m = [0, 0, 2]
[[reading]]
light = "key"
position_m = [1, 1, 0]
normal = [0, 0, 1]
illuminance_lx = 10
[[reading]]
light = "key"
normal = [0, 0, 1]
)" + ("position_m = " + place + "\nilluminance_lx = " + lux + "\n"));
    std::string text;
    const json warnings = LightcalJson("fit", {session}).value("warnings", json::array());
    for (const json& warning : warnings) {
      if (warning["code"] == "outside_room") text = warning["message"];
    }
    return text;
  };
  EXPECT_EQ(warned("[-1.5, 1, 0]", "7.5"), "");
  EXPECT_NE(warned("[-1.5, 2.5, 0]", "3.3").find("reading 1 (counted from 0) stands outside"),
            std::string::npos);
}

TEST(PlanCommand, SaysTheNextReadingsWithWhatTheyLeave) {
  const std::string session = SampleData("sessions/amaran_200x_s_bare");
  const json document = LightcalJson("plan", {session, "--light", "5600K", "--steps", "2"});
  ASSERT_EQ(document["lights"].size(), 1U);
  const json& plan = document["lights"][0];
  ASSERT_EQ(plan["steps"].size(), 2U);
  EXPECT_LT(double(plan["steps"][0]["u95_relative"]), double(plan["u95_relative"]));
  EXPECT_LT(double(plan["steps"][1]["u95_relative"]), double(plan["steps"][0]["u95_relative"]));
  EXPECT_GT(double(plan["steps"][0]["expected_lx"]), 0.0);
  EXPECT_NE(std::string(plan["advice"]).find("8 : 1"), std::string::npos);
  const TempDir out;
  const json run = LightcalJson("run", {session, "-o", out.path(), "--to", "json"});
  EXPECT_EQ(plan["next"], run["next_steps"]["5600K"]);
  const CliResult table = RunLightcal({"plan", session});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.out.find("next, for its minutes: " + std::string(plan["next"])),
            std::string::npos)
      << table.out;
  EXPECT_NE(table.out.find("take this reading"), std::string::npos);
  EXPECT_EQ(RunLightcal({"plan"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"plan", session, "--light", "kye"}).exit_code, 3);
}

TEST(PlanCommand, PlansBeforeAnyReading) {
  const TempDir dir;
  const std::string session =
      dir.Write("new.toml", "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n");
  const json plan = LightcalJson("plan", {session})["lights"][0];
  EXPECT_FALSE(plan.contains("u95_relative"));
  ASSERT_EQ(plan["steps"].size(), 3U);
  EXPECT_LT(double(plan["steps"][2]["u95_relative"]), double(plan["steps"][0]["u95_relative"]));
}

TEST(FitCommand, MonteCarloSaysHowManySamplesItTook) {
  const TempDir dir;
  const std::string session = dir.Write("one.toml",
                                        "lightcal = 1\n[[light]]\nname = \"key\"\nkind = "
                                        "\"point\"\n[[reading]]\nlight = \"key\"\ndistance_m = "
                                        "0.5\nilluminance_lx = 192\n");
  const CliResult result =
      RunLightcal({"fit", session, "-o", dir.path() + "/a.json", "--monte-carlo", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("0 samples"), std::string::npos) << result.err;
  const json u = json::parse(result.out)["lights"][0]["intensity_cd"];
  EXPECT_GT(double(u["value"]) - double(u["low95"]), 0.25 * double(u["value"]));
}

TEST(Explain, ListsEveryEffectWithBoundStateAndCost) {
  const CliResult result =
      RunLightcal({"explain", SampleData("sessions/three_real_lights"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json document = json::parse(result.out);
  ASSERT_EQ(document["lights"].size(), 3U);
  ASSERT_GE(document["lights"][0]["effects"].size(), 8U);
  for (const json& effect : document["lights"][0]["effects"]) {
    EXPECT_GE(double(effect["bound"]), 0.0) << effect;
    EXPECT_GT(double(effect["cost_ns"]), 0.0) << effect;
    EXPECT_FALSE(std::string(effect["reason"]).empty()) << effect;
  }
  double shares = 0.0;
  for (const json& part : document["lights"][0]["budget"]) {
    EXPECT_FALSE(std::string(part["halve"]).empty()) << part;
    shares += double(part["share"]);
  }
  EXPECT_NEAR(shares, 1.0, 1e-3);
}

TEST(Explain, NamesNothingOfPicturesWhereNobodyTookOne) {
  const std::string session = SampleData("sessions/three_real_lights");
  const CliResult result = RunLightcal({"explain", session, "--json"});
  EXPECT_EQ(result.out.find("rolling_shutter"), std::string::npos);
  EXPECT_EQ(result.out.find("veiling_glare"), std::string::npos);
  const CliResult told = RunLightcal({"explain", session});
  EXPECT_NE(told.out.find("not of this scene: "), std::string::npos);
  EXPECT_NE(told.out.find("what would halve it"), std::string::npos);
}

TEST(Explain, OverridesAreObeyed) {
  const std::string session = SampleData("sessions/three_real_lights");
  const auto states = [&](const std::string& effects) {
    const CliResult result = RunLightcal({"explain", session, "--effects", effects, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::map<std::string, std::string> out;
    const json document = json::parse(result.out);
    for (const json& effect : document["lights"][0]["effects"]) {
      out[effect["name"]] = effect["state"];
    }
    return out;
  };
  for (const auto& [name, state] : states("none")) EXPECT_EQ(state, "off") << name;
  EXPECT_EQ(states("all")["haze"], "on");
  EXPECT_EQ(states("auto")["haze"], "off");
  EXPECT_EQ(states("+haze,-distance_offset")["haze"], "on");
  EXPECT_EQ(states("+haze,-distance_offset")["distance_offset"], "off");
  EXPECT_EQ(RunLightcal({"explain", session, "--effects", "+hase"}).exit_code, 2);
}

// Bounded below the tolerance, simulated, fitted under a prior, or in the interval: no fifth state.
TEST(Explain, LeavesNothingOffAboveTheToleranceInAnySampleSession) {
  int sessions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SampleData("sessions"))) {
    if (!std::filesystem::exists(entry.path() / "session.toml")) continue;
    ++sessions;
    const json answer = LightcalJson("explain", {entry.path().string(), "--tol", "1%"});
    for (const json& light : answer["lights"]) {
      for (const json& effect : light["effects"]) {
        EXPECT_NE(effect.value("key", ""), "") << entry.path() << " " << effect["name"];
        if (effect["state"] != "off") continue;
        EXPECT_LE(double(effect["bound"]), 0.01) << entry.path() << " " << effect["name"];
      }
    }
  }
  EXPECT_GE(sessions, 11);
}

TEST(Explain, DrawsWhatTheGateSaves) {
  const TempDir out;
  const std::string svg = out.path() + "/gate.svg";
  const std::string session = SampleData("sessions/three_real_lights");
  ASSERT_EQ(RunLightcal({"explain", session, "--plot", svg}).exit_code, 0);
  const std::string picture = ReadFile(svg);
  for (const char* words : {"bare bulb, dark hall", "panel aslant, white room", "cob_bare",
                            "tolerance 1 %", "every effect", "what the gate calls for"}) {
    EXPECT_NE(picture.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(picture, ReadFile(std::string(LIGHTCAL_SOURCE_DIR) + "/lib/gate.svg"))
      << "draw lib/gate.svg anew: lightcal explain sample_data/sessions/three_real_lights "
         "--plot lib/gate.svg";
}

}  // namespace
}  // namespace lightcal::test
