// SPDX-License-Identifier: Apache-2.0
// lightcal validate, driven as a shell would: whole files of every format pass, broken ones are
// named with what and where.
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
using ::testing::HasSubstr;

json FileIn(const std::string& path) { return LightcalJson("validate", {path})["files"][0]; }

TEST(ValidateCommand, EverySampleSessionAndTapeIsWhole) {
  const json sessions = LightcalJson("validate", {SampleData("sessions")});
  EXPECT_GE(sessions["files"].size(), 11U);
  std::vector<std::string> tapes;
  for (const auto& entry : fs::directory_iterator(SampleData("tapes"))) {
    if (entry.path().extension() == ".tape") tapes.push_back(entry.path().string());
  }
  const json document = LightcalJson("validate", tapes);
  for (const json& file : document["files"]) {
    EXPECT_EQ(file["format"], "tape") << file;
    EXPECT_EQ(file["version"], "lightcal.tape/1") << file;
  }
}

TEST(ValidateCommand, RecognisesWhatOthersWrote) {
  EXPECT_EQ(FileIn(SampleData("photometric/sample2.ldt"))["format"], "EULUMDAT");
  EXPECT_EQ(FileIn(SampleData("spectra/own/argyll_ambient_2856K_500lx.sp"))["format"], "argyll_sp");
  EXPECT_EQ(FileIn(SampleData("lux_tables/own/typed_readings.csv"))["format"], "csv");
  EXPECT_EQ(FileIn(SampleData("camera_sensitivities/Nikon_D700_380_780_5.json"))["format"],
            "camera sensitivities");
}

// All that one run, one tradeoff and one calibration write.
TEST(ValidateCommand, PassesWhatLightcalWrites) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"run", SampleData("sessions/three_real_lights"), "-o", out, "--jobs", "1"})
                .exit_code,
            0);
  const std::string stem = out + "/three_real_lights";
  const json document = LightcalJson(
      "validate", {out + "/light.json", out + "/run.json", stem + ".preset.json", stem + ".gltf",
                   stem + ".blender.py", stem + ".three.js", stem + ".filament.json",
                   stem + "-cob_bare.ies", stem + "-cob_bare.ldt"});
  std::vector<std::string> formats;
  for (const json& file : document["files"]) {
    EXPECT_TRUE(file["ok"]) << file;
    formats.push_back(file["format"]);
  }
  EXPECT_THAT(formats,
              ::testing::ElementsAre("light", "run", "preset", "engine file", "engine file",
                                     "engine file", "engine file", "IES", "EULUMDAT"));
  const std::string profile = folder.Write(
      "profile.json", R"({"schema": "lightcal.profile/1", "tolerance_relative": 0.02})");
  EXPECT_EQ(FileIn(profile)["holds"], "tolerance 2.0 %");
}

// What stops on its way here is no preset, wherever it stops.
TEST(ValidateCommand, RefusesWhatIsCutOff) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  const std::string session = SampleData("sessions/three_real_lights");
  ASSERT_EQ(RunLightcal({"run", session, "-o", out, "--jobs", "1"}).exit_code, 0);
  std::vector<std::string> files;
  for (const char* ending : {".blender.py", ".three.js", ".usda", ".tscn", ".gltf",
                             ".filament.json", ".preset.json", "-cob_bare.gdtf"}) {
    const std::string name = std::string("three_real_lights") + ending;
    const std::string whole = ReadFile(out + "/" + name);
    EXPECT_TRUE(FileIn(out + "/" + name)["ok"]) << name;
    for (const std::size_t percent : {30U, 50U, 75U, 90U, 99U}) {
      const std::size_t size = whole.size() * percent / 100;
      files.push_back(folder.Write(std::to_string(percent) + "/" + name, whole.substr(0, size)));
    }
    files.push_back(folder.Write("2/" + name, whole.substr(0, whole.size() - 2)));
  }
  std::vector<std::string> command = files;
  command.insert(command.begin(), "validate");
  command.emplace_back("--json");
  const CliResult result = RunLightcal(command);
  EXPECT_EQ(result.exit_code, 3);
  const json judged = json::parse(result.out)["files"];
  EXPECT_EQ(judged.size(), files.size());
  for (const json& file : judged) EXPECT_FALSE(file["ok"]) << file;
  const CliResult check = RunLightcal(
      {"check", folder.path() + "/50/three_real_lights.blender.py", "--session", session});
  EXPECT_EQ(check.exit_code, 3);
  EXPECT_THAT(check.err, HasSubstr("cut off"));
}

// What no engine can use is no preset, whole as it is: by KHR_lights_punctual, and by what a
// number is. check says so, too.
TEST(ValidateCommand, RefusesWhatNoEngineCanUse) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  const std::string session = SampleData("sessions/three_real_lights");
  ASSERT_EQ(RunLightcal({"run", session, "-o", out, "--jobs", "1"}).exit_code, 0);
  const std::string stem = out + "/three_real_lights";
  const json whole = json::parse(ReadFile(stem + ".gltf"));
  const auto with = [&](const json& patch) {
    json document = whole;
    json& light = document["extensions"]["KHR_lights_punctual"]["lights"][0];
    light.merge_patch(patch);
    return document.dump();
  };
  const auto cone = [](double inner, double outer) {
    return json{{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}};
  };
  const struct {
    json patch;
    const char* said;
  } kFaults[] = {{{{"intensity", -5.0}}, "its intensity is below 0"},
                 {{{"type", "pint"}}, "none of point, spot, directional"},
                 {cone(0.9, 0.5), "innerConeAngle"},
                 {cone(0.5, 0.5), "innerConeAngle"},
                 {cone(-0.1, 0.5), "innerConeAngle"},
                 {cone(0.1, 1.6), "beyond pi/2"},
                 {{{"color", {1.7, 1.0, 1.0}}}, "color"},
                 {{{"color", {1.0, -0.1, 1.0}}}, "color"},
                 {{{"range", 0.0}}, "range"}};
  for (const auto& fault : kFaults) {
    const std::string file = folder.Write("wrong.gltf", with(fault.patch));
    const CliResult validated = RunLightcal({"validate", file});
    EXPECT_EQ(validated.exit_code, 3) << fault.patch;
    EXPECT_THAT(validated.out, HasSubstr(fault.said));
    const CliResult checked = RunLightcal({"check", file, "--session", session});
    EXPECT_EQ(checked.exit_code, 3) << fault.patch;
    EXPECT_THAT(checked.err, HasSubstr(fault.said));
  }
  const std::string right = folder.Write("right.gltf", with(cone(0.0, 1.5707963)));
  EXPECT_EQ(RunLightcal({"validate", right}).exit_code, 0);
  // The first of it: "= 203.38" -> "= x203.38".
  const auto with_x = [&](const std::string& ending, const std::string& key) {
    std::string text = ReadFile(stem + ending);
    const std::size_t at = text.find(key + " = ");
    EXPECT_NE(at, std::string::npos) << ending;
    return folder.Write("wrong" + ending, text.insert(at + key.size() + 3, "x"));
  };
  for (const std::string& file :
       {with_x(".tscn", "light_intensity_lumens"), with_x(".tscn", "omni_range"),
        with_x(".usda", "inputs:intensity")}) {
    for (const CliResult& result :
         {RunLightcal({"validate", file}), RunLightcal({"check", file, "--session", session})}) {
      EXPECT_EQ(result.exit_code, 3) << file;
      EXPECT_THAT(result.out + result.err, HasSubstr("is no number: x"));
    }
  }
}

// No Python is asked: a script that is as written runs, of another only its brackets are known.
TEST(ValidateCommand, SaysThatAnEditedScriptWasNotChecked) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"run", SampleData("sessions/three_real_lights"), "-o", out, "--jobs", "1"})
                .exit_code,
            0);
  for (const std::string& ending : {std::string(".blender.py"), std::string(".three.js")}) {
    const std::string text = ReadFile(out + "/three_real_lights" + ending);
    const std::string own = folder.Write("own" + ending, text);
    EXPECT_EQ(RunLightcal({"validate", own, "--strict"}).exit_code, 0) << ending;
    const std::size_t at = text.find(ending == ".three.js" ? "\nfunction " : "\ndef ");
    ASSERT_NE(at, std::string::npos);
    const std::string edited =
        folder.Write("edited" + ending, std::string(text).insert(at, "\n* 3 wrong"));
    const json file = FileIn(edited);
    EXPECT_THAT(file["holds"], HasSubstr("its script not checked"));
    const CliResult result = RunLightcal({"validate", edited, "--strict"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("was not checked"));
  }
  const std::string text = ReadFile(out + "/three_real_lights.blender.py");
  const std::size_t def = text.find("\ndef ");
  const std::string open =
      folder.Write("open.blender.py", std::string(text).insert(def, "\nx = (1"));
  EXPECT_EQ(RunLightcal({"validate", open}).exit_code, 3);
}

// Exported before scenes said by which line they end.
TEST(ValidateCommand, RefusesALightOfAnOldSceneThatIsCutOff) {
  const TempDir folder;
  const std::string head = "[gd_scene format=3]\n\n; lightcal 0.1.0, schema-checked.\n\n";
  const std::string lamp =
      "[node name=\"a\" type=\"OmniLight3D\" parent=\".\"]\nlight_intensity_lumens = 100\n"
      "metadata/lightcal = {\n\"name\": \"a\"\n}\n";
  const std::string begun = "\n[node name=\"b\" type=\"OmniLight3D\" parent=\".\"]\n";
  EXPECT_TRUE(FileIn(folder.Write("whole.tscn", head + lamp))["ok"]);
  const CliResult cut = RunLightcal({"validate", folder.Write("cut.tscn", head + lamp + begun)});
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_THAT(cut.out, HasSubstr("what ends its light \"b\""));
  // As the editor saves it: a light that is as the engine's defaults are.
  EXPECT_TRUE(FileIn(folder.Write("own.tscn", "[gd_scene format=3]\n" + lamp + begun))["ok"]);
}

// By hand: another quote, a comment, a function of one's own, an editor that drops comments.
TEST(ValidateCommand, PassesWhatAPersonEdited) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"run", SampleData("sessions/three_real_lights"), "-o", out, "--jobs", "1"})
                .exit_code,
            0);
  const std::string stem = out + "/three_real_lights";
  const auto edited = [&](const std::string& ending, const auto& edit) {
    std::string text = ReadFile(stem + ending);
    edit(text);
    const json file = FileIn(folder.Write("edited" + ending, text));
    EXPECT_TRUE(file["ok"]) << file;
  };
  edited(".blender.py", [](std::string& text) {
    text.replace(text.rfind("'__main__'"), 10, "\"__main__\"");
    text += "print('it\\'s (done')  # don't (worry\n";
  });
  edited(".three.js", [](std::string& text) {
    text += "// it's {mine\nexport const strip = (s) => s.replace(/[\"'({]/g, `}`);\n";
  });
  edited(".three.js", [](std::string& text) { text.pop_back(); });
  edited(".usda", [](std::string& text) {
    text.insert(text.find("\n(\n") + 3, "  comment = \"\"\"two {\nlines\"\"\" # (mine\n");
  });
  edited(".tscn", [](std::string& text) {
    std::string kept;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at) + 1;
      if (text[at] != ';') kept += text.substr(at, end - at);
      at = end;
    }
    text = kept;
  });
}

struct Fault {
  const char* name;
  const char* file;
  const char* contents;
  const char* code;
  const char* says;
};
class ValidateFault : public ::testing::TestWithParam<Fault> {};

TEST_P(ValidateFault, IsNamedWithWhatAndWhere) {
  const TempDir folder;
  const std::string path = folder.Write(GetParam().file, GetParam().contents);
  const CliResult result = RunLightcal({"validate", path, "--json"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(document["error"]["code"], "invalid");
  const json& file = document["files"][0];
  EXPECT_FALSE(file["ok"]);
  EXPECT_EQ(file["error"]["code"], GetParam().code) << file;
  const std::string told =
      std::string(file["error"]["subject"]) + ": " + std::string(file["error"]["message"]);
  EXPECT_THAT(told, HasSubstr(GetParam().says));
  EXPECT_THAT(RunLightcal({"validate", path}).out, HasSubstr("refused"));
}

INSTANTIATE_TEST_SUITE_P(
    Files, ValidateFault,
    ::testing::Values(
        Fault{"session_key", "session.toml",
              "lightcal = 1\n[[light]]\nname = \"a\"\nkynd = \"point\"\n", "unknown_key", "kind"},
        Fault{"light_key", "light.json",
              R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point","flux":1}]})",
              "unknown_key", "flux"},
        Fault{"light_syntax", "light.json", "{\"schema\":\"lightcal.light/1\",\"lights\":[",
              "bad_light", "light.json"},
        Fault{"light_version", "light.json", R"({"schema":"lightcal.light/9","lights":[]})",
              "unknown_version", "lightcal.light/1"},
        Fault{"preset", "a.preset.json", R"({"schema":"lightcal.preset/1","lights":[{}]})",
              "bad_preset", "a.preset.json"},
        Fault{"profile", "p.json", R"({"schema":"lightcal.profile/1","tolerance_relative":-1})",
              "bad_profile", "tolerance_relative"},
        Fault{"camera", "c.json", R"({"schema":"lightcal.camera/1","width":"wide"})", "bad_camera",
              "width"},
        Fault{"capture", "capture.json", R"({"schema":"lightcal.capture/1","frames":3})",
              "unknown_key", "frames"},
        Fault{"tape", "a.tape", "{\"schema\":\"lightcal.tape/1\",\"driver\":\"x\"}\n{\"t_ms\":1}\n",
              "bad_tape", ":2"},
        Fault{"run", "run.json", R"({"schema":"lightcal.run/1"})", "bad_run", "missing"},
        Fault{"journal", "readings.jsonl",
              "{\"light\":\"a\",\"distance_m\":1,\"illuminance_lx\":5}\n{\"light\":\"a\","
              "\"distance_m\":-1,\"illuminance_lx\":5}\n",
              "bad_reading", "readings.jsonl:2"},
        Fault{"meters", "meters.toml",
              "lightcal = 1\n[[calibration]]\ndevice = \"hid_als:1\"\nfactor = 1000\n",
              "bad_meters", "factor"},
        Fault{"ies", "a.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 two\n", "bad_photometric", "a.ies"},
        Fault{"other_json", "x.json", R"({"answer": 42})", "unknown_format", "schema"},
        Fault{"other_text", "x.txt", "to whom it may concern\n", "unknown_format",
              "validate --help"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(ValidateCommand, ASessionIsCheckedWithItsJournalAndTheFilesItNames) {
  const TempDir folder;
  const std::string toml =
      "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n[[reading]]\nlight = "
      "\"key\"\ndistance_m = 1\nilluminance_lx = 100\n";
  folder.Write("lamp/session.toml", toml);
  const std::string lamp = folder.path() + "/lamp";
  EXPECT_EQ(FileIn(lamp)["holds"], "1 light, 1 reading");
  EXPECT_EQ(FileIn(SampleData("sessions/dimmed_panels"))["holds"], "3 lights, 21 readings");
  EXPECT_EQ(FileIn(SampleData("sessions/mixing_panel"))["holds"], "1 light, 12 readings");
  const std::string row = "{\"light\":\"key\",\"distance_m\":2,\"illuminance_lx\":25}\n";
  folder.Write("lamp/readings.jsonl", row + "{\"light\":\"kye\",\"distance_m\":2,\"illumina");
  EXPECT_EQ(FileIn(lamp)["holds"], "1 light, 2 readings");
  EXPECT_THAT(RunLightcal({"validate", lamp}).err, HasSubstr("stops in the middle"));
  EXPECT_EQ(RunLightcal({"validate", lamp, "--strict"}).exit_code, 3);
  folder.Write("lamp/readings.jsonl",
               row + "{\"light\":\"kye\",\"distance_m\":2,\"illuminance_lx\":25}\n");
  const CliResult strange = RunLightcal({"validate", lamp + "/readings.jsonl"});
  EXPECT_EQ(strange.exit_code, 3);
  EXPECT_THAT(strange.out, HasSubstr("readings.jsonl:2"));
  EXPECT_THAT(strange.out, HasSubstr("did you mean \"key\"?"));
  folder.Write("lamp/readings.jsonl", row);
  folder.Write("lamp/session.toml", toml + "spectrum = \"lost.csv\"\n");
  const CliResult lost = RunLightcal({"validate", lamp});
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_THAT(lost.out, HasSubstr("lost.csv"));
}

TEST(ValidateCommand, AFileThatIsNotThereFailsAndTheOthersAreStillRead) {
  const TempDir folder;
  const std::string good = folder.Write("a.json", LightFileToJson(FileOf({WarmPoint()})).value());
  const CliResult result = RunLightcal({"validate", folder.path() + "/none.json", good, "--json"});
  EXPECT_EQ(result.exit_code, 1);
  const json document = json::parse(result.out);
  EXPECT_FALSE(document["files"][0]["ok"]);
  EXPECT_EQ(document["files"][0]["error"]["code"], "not_found");
  EXPECT_TRUE(document["files"][1]["ok"]);
  EXPECT_EQ(RunLightcal({"validate"}).exit_code, 2);
}

}  // namespace
}  // namespace lightcal::test
