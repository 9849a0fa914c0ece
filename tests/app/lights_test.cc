// SPDX-License-Identifier: Apache-2.0
// lightcal lights, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lightcal/records/light_codec.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FittedLight Lamp(const std::string& name, LightKind kind, double cd, double lm, double cct) {
  FittedLight light = SimpleLight(name, kind, cd);
  light.flux_lm = Uncertain{lm, 0.1 * lm, std::nullopt, std::nullopt};
  light.color.cct_K = Uncertain{cct, 60.0, std::nullopt, std::nullopt};
  return light;
}

class Library : public ::testing::Test {
 protected:
  Library() {
    const std::string input = folder.Write(
        "stage.json",
        LightFileToJson(FileOf({Lamp("Desk lamp", LightKind::kPoint, 40, 500, 2900),
                                Lamp("Key spot", LightKind::kSpot, 9000, 800, 3250),
                                Lamp("fill", LightKind::kRect, 700, 2000, 5600), Sun()}))
            .value());
    EXPECT_EQ(RunLightcal({"lights", "--library", library, "add", input}).exit_code, 0);
  }
  std::vector<std::string> Names(std::vector<std::string> words) {
    words.insert(words.begin(), {"--library", library, "list"});
    std::vector<std::string> names;
    const json document = LightcalJson("lights", words);
    for (const json& light : document["lights"]) names.push_back(light["name"]);
    return names;
  }

  TempDir folder;
  std::string library = folder.path() + "/library";
};

TEST_F(Library, KeepsOneFileALightAndAddingAgainChangesNothing) {
  const auto files = [&] {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(library)) {
      names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
  };
  const auto first = files();
  EXPECT_EQ(first.size(), 4U);
  EXPECT_TRUE(first[0].starts_with("Desk-lamp-")) << first[0];
  ASSERT_EQ(
      RunLightcal({"lights", "--library", library, "add", folder.path() + "/stage.json"}).exit_code,
      0);
  EXPECT_EQ(files(), first);
  const std::string again = folder.Write(
      "again.json",
      LightFileToJson(FileOf({Lamp("Desk lamp", LightKind::kPoint, 41, 510, 2910)})).value());
  LightFile measured = LightFileFromJson(ReadFile(again), again).value();
  measured.provenance.inputs = {{"session.toml", std::string(64, 'b')}};
  folder.Write("again.json", LightFileToJson(measured).value());
  ASSERT_EQ(RunLightcal({"lights", "--library", library, "add", again}).exit_code, 0);
  EXPECT_EQ(files().size(), 5U) << "a new measurement stands beside the old one";
}

TEST_F(Library, FindsByRangesKindAndName) {
  EXPECT_THAT(Names({}), ElementsAre("Desk lamp", "fill", "Key spot", "sun"));
  EXPECT_THAT(Names({"--cct", "3000..3500"}), ElementsAre("Key spot"));
  EXPECT_THAT(Names({"--lm", "600.."}), ElementsAre("fill", "Key spot"));
  EXPECT_THAT(Names({"--cct", "..3250K", "--cd", "..100"}), ElementsAre("Desk lamp"));
  EXPECT_THAT(Names({"--lx", "1000lx.."}), ElementsAre("sun"));
  EXPECT_THAT(Names({"--kind", "rect"}), ElementsAre("fill"));
  EXPECT_THAT(Names({"--name", "SPOT"}), ElementsAre("Key spot"));
  EXPECT_THAT(Names({"--cct", "9000.."}), IsEmpty());
  EXPECT_THAT(Names({"--sort", "-cd"}), ElementsAre("Key spot", "fill", "Desk lamp", "sun"));
}

TEST_F(Library, WrongQuestionsSayWhatIsMeant) {
  const auto refused = [&](const std::vector<std::string>& words, const std::string& says) {
    std::vector<std::string> line = {"lights", "--library", library, "list"};
    line.insert(line.end(), words.begin(), words.end());
    const CliResult result = RunLightcal(line);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_THAT(result.err, HasSubstr(says));
  };
  refused({"--cct", "warm"}, "3000..3500");
  refused({"--cct", "3500..3000"}, "below its beginning");
  refused({"--kind", "spt"}, "did you mean spot?");
  refused({"--sort", "size"}, "-");
  EXPECT_EQ(RunLightcal({"lights", "--library", folder.path() + "/none", "list"}).exit_code, 1);
}

TEST_F(Library, ShowsOneAndAsksWhichOfSeveral) {
  const json shown = LightcalJson("lights", {"--library", library, "show", "Key spot"});
  EXPECT_EQ(shown["lights"][0]["name"], "Key spot");
  EXPECT_EQ(shown["schema"], "lightcal.light/1");
  EXPECT_EQ(RunLightcal({"lights", "--library", library, "show", "desk"}).exit_code, 0);
  const CliResult several = RunLightcal({"lights", "--library", library, "show", "s"});
  EXPECT_EQ(several.exit_code, 3);
  EXPECT_THAT(several.err, HasSubstr("Key-spot-"));
  EXPECT_EQ(RunLightcal({"lights", "--library", library, "show", "nobody"}).exit_code, 3);
}

TEST_F(Library, TheSheetHasATileForEachLight) {
  for (const char* name : {"sheet.html", "sheet.svg"}) {
    const std::string path = folder.path() + "/" + name;
    ASSERT_EQ(RunLightcal({"lights", "--library", library, "sheet", "-o", path}).exit_code, 0);
    const std::string sheet = ReadFile(path);
    for (const char* word : {"Desk lamp", "Key spot", "fill", "sun", "9000\u00A0cd", "3250 ±"}) {
      EXPECT_THAT(sheet, HasSubstr(word)) << name;
    }
  }
  const std::string png = folder.path() + "/sheet.png";
  ASSERT_EQ(RunLightcal({"lights", "--library", library, "sheet", "-o", png}).exit_code, 0);
  EXPECT_TRUE(ReadFile(png).starts_with("\x89PNG"));
  EXPECT_EQ(RunLightcal({"lights", "--library", library, "sheet", "-o", "sheet.pdf"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"lights", "--library", library, "sheet", "--cct", "9000..", "-o", png})
                .exit_code,
            3);
}

TEST_F(Library, TheDefaultFolderIsThePersons) {
  const CliResult added = RunLightcal({"lights", "add", folder.path() + "/stage.json"}, "",
                                      {"XDG_DATA_HOME=" + folder.path() + "/data"});
  ASSERT_EQ(added.exit_code, 0) << added.err;
  EXPECT_TRUE(fs::is_directory(folder.path() + "/data/lightcal/lights"));
}

TEST_F(Library, OneIsTakenOutOrRenamedByItsWholeName) {
  const auto lights = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"lights", "--library", library});
    return RunLightcal(words);
  };
  const CliResult part = lights({"remove", "Desk"});
  EXPECT_EQ(part.exit_code, 3);
  EXPECT_THAT(part.err, HasSubstr("did you mean \"Desk lamp\""));
  EXPECT_EQ(Names({}).size(), 4U);
  const CliResult taken = lights({"rename", "Desk lamp", "Desk lamp"});
  EXPECT_EQ(taken.exit_code, 1);
  EXPECT_THAT(taken.err, HasSubstr("called already"));
  EXPECT_EQ(lights({"rename", "Desk lamp", "Reading lamp"}).exit_code, 0);
  EXPECT_THAT(Names({"--name", "lamp"}), ElementsAre("Reading lamp"));
  EXPECT_EQ(LightcalJson("lights", {"--library", library, "show",
                                    "Reading lamp"})["lights"][0]["intensity_cd"]["value"],
            40);
  EXPECT_EQ(lights({"remove", "Reading lamp"}).exit_code, 0);
  EXPECT_EQ(Names({}).size(), 3U);
  EXPECT_EQ(lights({"remove", "Reading lamp"}).exit_code, 3);
}

TEST_F(Library, ALightMayBeRenamedAndABrokenFileIsPassedOver) {
  const std::string one = folder.Write(
      "one.json", LightFileToJson(FileOf({Lamp("key", LightKind::kPoint, 50, 600, 2700)})).value());
  ASSERT_EQ(
      RunLightcal({"lights", "--library", library, "add", one, "--as", "Kitchen, left"}).exit_code,
      0);
  EXPECT_THAT(Names({"--name", "kitchen"}), ElementsAre("Kitchen, left"));
  EXPECT_EQ(RunLightcal(
                {"lights", "--library", library, "add", folder.path() + "/stage.json", "--as", "x"})
                .exit_code,
            2);
  folder.Write("library/broken.json", "{\"schema\": \"lightcal.light/1\", \"lights\": [");
  const CliResult listed = RunLightcal({"lights", "--library", library, "list"});
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_THAT(listed.err, HasSubstr("broken.json"));
}

}  // namespace
}  // namespace lightcal::test
