// SPDX-License-Identifier: Apache-2.0
// lightcal export, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

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

}  // namespace
}  // namespace lightcal::test
