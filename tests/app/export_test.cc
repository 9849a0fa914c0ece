// SPDX-License-Identifier: Apache-2.0
// lightcal export, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "lightcal/records/light_codec.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

std::string WriteLights(const TempDir& folder, const std::vector<FittedLight>& lights,
                        const std::string& name = "lamp.json") {
  const auto text = LightFileToJson(FileOf(lights));
  EXPECT_TRUE(text.has_value());
  return folder.Write(name, *text);
}

std::size_t FilesIn(const std::string& folder) {
  if (!fs::exists(folder)) return 0;
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ExportCommand, WritesEveryTargetNamedAfterTheJson) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint(), Spot()});
  const std::string out = folder.path() + "/out";
  const CliResult result = RunLightcal({"export", input, "-o", out, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json document = json::parse(result.out);
  std::set<std::string> names;
  for (const json& file : document["files"]) names.insert(fs::path(std::string(file)).filename());
  for (const char* name :
       {"lamp.gltf", "lamp.preset.json", "lamp-key.ies", "lamp-key.ldt", "lamp-spot.ies",
        "lamp-spot.ldt", "lamp.tscn", "lamp.usda", "lamp.unreal.py", "lamp.t3d", "lamp.unity.json",
        "LightcalImporter.cs", "lamp.mitsuba.xml", "lamp.pbrt"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  const json gltf = json::parse(ReadFile(out + "/lamp.gltf"));
  EXPECT_EQ(gltf["nodes"].size(), 2U) << "two lights and nothing else";
  EXPECT_EQ(json::parse(ReadFile(out + "/lamp.preset.json"))["schema"], "lightcal.preset/1");
}

TEST(ExportCommand, SameInputSameBytesAndFreelyReplaced) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint()});
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"export", input, "-o", out}).exit_code, 0);
  const std::string first = ReadFile(out + "/lamp.gltf");
  ASSERT_EQ(RunLightcal({"export", input, "-o", out}).exit_code, 0);
  EXPECT_EQ(ReadFile(out + "/lamp.gltf"), first);
}

TEST(ExportCommand, TheRigIsASecondFileOfItsOwn) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint(), Spot()});
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"export", "--rig", "-o", out, "--to", "gltf,json,ies", input}).exit_code,
            0);
  EXPECT_EQ(FilesIn(out), 6U) << "two gltf, two json, an ies a light";
  EXPECT_EQ(json::parse(ReadFile(out + "/lamp.gltf"))["nodes"].size(), 2U);
  const json rig = json::parse(ReadFile(out + "/lamp.rig.gltf"));
  EXPECT_EQ(rig["nodes"].size(), 5U) << "two lights, two cards, a camera";
  EXPECT_EQ(rig["scenes"][0]["name"], "lamp.rig");
}

TEST(ExportCommand, OnlyTheTargetsNamedAndBareIsWhatIsDoneAnyway) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint()});
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"export", "--bare", "-o", out, "--to", "gltf", input}).exit_code, 0);
  EXPECT_EQ(FilesIn(out), 1U);
  EXPECT_EQ(json::parse(ReadFile(out + "/lamp.gltf"))["nodes"].size(), 1U);
}

TEST(ExportCommand, AllIsEveryTargetAndSeveralArePartedByCommas) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint()});
  const auto files = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"export", input, "-o", folder.path() + "/" + out});
    EXPECT_EQ(RunLightcal(more).exit_code, 0);
    return FilesIn(folder.path() + "/" + out);
  };
  EXPECT_EQ(files("named", {"--to", "all"}), files("unnamed", {}));
  const CliResult blanks = RunLightcal({"export", input, "--to", "gltf", "usd"});
  EXPECT_EQ(blanks.exit_code, 2);
  EXPECT_NE(blanks.err.find("--to gltf,usd"), std::string::npos) << blanks.err;
  EXPECT_EQ(RunLightcal({"quick", "52lx@1m", "--to", "all", "-o", folder.path() + "/q"}).exit_code,
            0);
}

TEST(ExportCommand, AnUnknownTargetIsWrongUsageAndNamesTheNearest) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint()});
  const std::string out = folder.path() + "/out";
  const CliResult result = RunLightcal({"export", input, "--to", "json,gtlf", "-o", out, "--json"});
  EXPECT_EQ(result.exit_code, 2);
  const json error = json::parse(result.out)["error"];
  EXPECT_EQ(error["code"], "usage");
  EXPECT_THAT(std::string(error["message"]), HasSubstr("did you mean gltf?"));
  EXPECT_EQ(FilesIn(out), 0U);
}

TEST(ExportCommand, SubstitutionsAreWarnedOnceAndStrictRefusesThem) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {SimpleLight("panel", LightKind::kRect, 900.0)});
  const std::string out = folder.path() + "/out";
  const CliResult refused = RunLightcal({"export", input, "-o", out, "--strict"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(FilesIn(out), 0U);
  const CliResult result = RunLightcal({"export", input, "-o", out, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json warnings = json::parse(result.out)["warnings"];
  ASSERT_EQ(warnings.size(), 1U) << warnings;
  EXPECT_EQ(warnings[0]["code"], "substituted");
  EXPECT_EQ(warnings[0]["subject"], "panel");
}

TEST(ExportCommand, NeverReplacesWhatItDidNotWrite) {
  const TempDir folder;
  const std::string input = WriteLights(folder, {WarmPoint()});
  folder.Write("lamp.gltf", "a scene by hand");
  const CliResult refused = RunLightcal({"export", input, "-o", folder.path()});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_FALSE(fs::exists(folder.path() + "/lamp.preset.json"));
  EXPECT_EQ(ReadFile(folder.path() + "/lamp.gltf"), "a scene by hand");
  EXPECT_EQ(RunLightcal({"export", input, "-o", folder.path(), "--force"}).exit_code, 0);
}

TEST(ExportCommand, BadInputsWriteNothing) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  EXPECT_EQ(RunLightcal({"export", folder.path() + "/none.json", "-o", out}).exit_code, 1);
  EXPECT_EQ(RunLightcal({"export", folder.Write("bad.json", "{"), "-o", out}).exit_code, 3);
  EXPECT_EQ(RunLightcal({"export", "-o", out}).exit_code, 2);
  FittedLight dim = WarmPoint();
  dim.intensity_cd.reset();
  const CliResult result = RunLightcal({"export", WriteLights(folder, {dim}), "-o", out});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("key"));
  EXPECT_EQ(FilesIn(out), 0U);
}

TEST(ExportCommand, TwoInputsOfOneStemWouldOverwriteEachOther) {
  const TempDir a;
  const TempDir b;
  const CliResult result = RunLightcal(
      {"export", WriteLights(a, {WarmPoint()}), WriteLights(b, {Spot()}), "-o", a.path() + "/out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(FilesIn(a.path() + "/out"), 0U);
}

// Four warnings of one cause stand together, each lamp behind its own figure.
TEST(ExportCommand, NoWarningStatesOneLampsErrorOfAnother) {
  const TempDir folder;
  std::vector<FittedLight> lamps;
  for (const double inner : {5.0, 10.0, 15.0, 20.0, 29.0}) {
    FittedLight lamp = Spot();
    lamp.name = "spot" + std::to_string(static_cast<int>(inner));
    lamp.inner_deg = inner;
    lamp.outer_deg = 30.0;
    lamps.push_back(lamp);
  }
  const CliResult result = RunLightcal({"export", WriteLights(folder, lamps), "--to", "unity,godot",
                                        "-o", folder.path() + "/out", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  int together = 0;
  const json document = json::parse(result.out);
  for (const json& warning : document["warnings"]) {
    if (warning["code"] != "cone_profile") continue;
    ++together;
    const std::string message = warning["message"];
    const std::string subject = warning["subject"];
    bool told = false;
    std::istringstream lines(result.err);
    for (std::string line; std::getline(lines, line);) {
      told = told || (line.ends_with(": " + message) && line.find(subject) != std::string::npos);
    }
    EXPECT_TRUE(told) << subject << ": " << message << "\nis not in\n" << result.err;
  }
  EXPECT_GT(together, 3);
}

// KHR_lights_punctual: (1 - (d/r)^4)/d^2, the window not squared. At 2 of 3 m it leaves 65/81.
TEST(ExportCommand, CheckReadsAGltfByItsOwnRangeWindow) {
  const TempDir folder;
  const std::string session = folder.path() + "/s";
  fs::create_directories(session);
  folder.Write("s/session.toml",
               "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
               "[[reading]]\nlight = \"key\"\ndistance_m = 1\nilluminance_lx = 100\n"
               "[[reading]]\nlight = \"key\"\ndistance_m = 2\nilluminance_lx = 25\n");
  const std::string light = session + "/out/light.json";
  ASSERT_EQ(RunLightcal({"fit", session, "-o", light}).exit_code, 0);
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"export", light, "--to", "gltf", "--range", "3", "-o", out}).exit_code, 0);
  const json gltf = json::parse(ReadFile(out + "/light.gltf"));
  const json& written = gltf["extensions"]["KHR_lights_punctual"]["lights"][0];
  const double candela = written["intensity"];
  const CliResult checked =
      RunLightcal({"check", out + "/light.gltf", "--session", session, "--json"});
  const json rows = json::parse(checked.out)["readings"];
  EXPECT_NEAR(rows[1]["predicted_lx"].get<double>() / rows[0]["predicted_lx"].get<double>(),
              (65.0 / 81.0) / 4.0 / (80.0 / 81.0), 0.01);
  EXPECT_NEAR(rows[1]["predicted_lx"].get<double>(), candela * (65.0 / 81.0) / 4.0, 0.02 * 25.0);
}

// A bulb that its readings found, under which the meter lay flat: 120 cd at (.1, -.05, 2.2).
TEST(ExportCommand, CheckLooksForALampWhereItWasFound) {
  const TempDir folder;
  const std::string session = folder.path() + "/s";
  fs::create_directories(session);
  std::string toml =
      "lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = \"m\"\nsigma_relative = 0.01\n"
      "[[light]]\nname = \"bulb\"\nkind = \"point\"\n";
  for (const auto& [x, y] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0),
                             std::pair(-1.0, 1.0), std::pair(0.0, 0.0)}) {
    const double d2 = (x - 0.1) * (x - 0.1) + (y + 0.05) * (y + 0.05) + 2.2 * 2.2;
    toml += "[[reading]]\nlight = \"bulb\"\nmeter = \"m\"\nposition_m = [" + std::to_string(x) +
            ", " + std::to_string(y) + ", 0]\nnormal = [0, 0, 1]\nilluminance_lx = " +
            std::to_string(120.0 * 2.2 / std::pow(d2, 1.5)) + "\n";
  }
  folder.Write("s/session.toml", toml);
  const std::string light = session + "/out/light.json";
  ASSERT_EQ(RunLightcal({"fit", session, "-o", light}).exit_code, 0);
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"export", light, "--to", "ies", "-o", out}).exit_code, 0);
  const CliResult checked =
      RunLightcal({"check", out + "/light-bulb.ies", "--session", session, "--json"});
  const json rows = json::parse(checked.out)["readings"];
  EXPECT_EQ(rows.size(), 5U);
  for (const json& row : rows) {
    EXPECT_NEAR(row["predicted_lx"].get<double>() / row["measured_lx"].get<double>(), 1.0, 0.02);
  }
  // Turned to the lamp each reading is its intensity, though the meter lay flat.
  const json fitted = json::parse(ReadFile(light))["lights"][0];
  for (const json& row : fitted["residuals"]) {
    const double facing = row["measured_lx"].get<double>() * row["facing_lx"].get<double>() /
                          row["predicted_lx"].get<double>();
    EXPECT_NEAR(facing * std::pow(row["distance_m"].get<double>(), 2.0),
                fitted["intensity_cd"]["value"].get<double>(), 0.5);
  }
}

}  // namespace
}  // namespace lightcal::test
