// SPDX-License-Identifier: Apache-2.0
// What strangers' files and slips of the hand must not do: write elsewhere, steer a terminal, work
// through a disk, hang, or be answered in words of the inside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

// An ordinary room: at 2 m four of ten lux come off the walls (README).
std::string SessionToml(const std::string& name, double factor = 1.0) {
  std::string toml = "lightcal = 1\n";
  for (const char* light : {"", "2"}) {
    toml += "[[light]]\nname = \"" + name + light + "\"\nkind = \"point\"\nfixture = \"bulb\"\n";
    for (const auto& [distance, lux] :
         {std::pair(0.5, 203.0), std::pair(1.0, 58.0), std::pair(2.0, 20.0)}) {
      toml += "[[reading]]\nlight = \"" + name + light +
              "\"\ndistance_m = " + std::to_string(distance) +
              "\nilluminance_lx = " + std::to_string(lux * factor) + "\n";
    }
  }
  return toml;
}

class StrangersFiles : public ::testing::Test {
 protected:
  std::size_t Files() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      count += entry.is_regular_file() ? 1U : 0U;
    }
    return count;
  }
  static CliResult Answer(const std::vector<std::string>& command, int exit_code) {
    SCOPED_TRACE(testing::PrintToString(command));
    CliResult result = RunLightcal(command);
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    for (const std::string* text : {&result.out, &result.err}) {
      EXPECT_EQ(text->find('\x1b'), std::string::npos);
      EXPECT_EQ(text->find("\xE2\x80\xAE"), std::string::npos);
      EXPECT_EQ(text->find("json.exception"), std::string::npos) << *text;
    }
    return result;
  }

  TempDir folder_;
};

// ---- check: relative to the measurement, missing lamps counted ----

TEST_F(StrangersFiles, APresetThatIsOffIsExitOneAndOneThatIsRightIsZero) {
  const std::string session = folder_.path() + "/s";
  folder_.Write("s/session.toml", SessionToml("key"));
  ASSERT_EQ(RunLightcal({"run", session}).exit_code, 0);
  const std::string preset = session + "/out/s.gltf";
  const json right = LightcalJson("check", {preset, "--session", session});
  EXPECT_LT(right.at("rms_relative").get<double>(), 0.05);
  EXPECT_FALSE(right.contains("missing"));
  // The walls' part is named, and is what the preset need not give.
  EXPECT_GT(right.at("readings").at(2).at("walls_lx").get<double>(), 4.0);

  json gltf = json::parse(ReadFile(preset));
  json& lights = gltf["extensions"]["KHR_lights_punctual"]["lights"];
  const auto spoilt = [&](const json& changed) {
    return folder_.Write("spoilt.gltf", changed.dump());
  };
  const auto times = [&](double factor) {
    json changed = gltf;
    for (json& light : changed["extensions"]["KHR_lights_punctual"]["lights"]) {
      light["intensity"] = light["intensity"].get<double>() * factor;
    }
    return changed;
  };
  // Below 0 is no intensity of KHR_lights_punctual's.
  Answer({"check", spoilt(times(-1.0)), "--session", session}, 3);
  for (const double factor : {10.0, 0.0, 0.5}) {
    const json changed = times(factor);
    const CliResult result = Answer({"check", spoilt(changed), "--session", session, "--json"}, 1);
    const json answer = json::parse(result.out);
    EXPECT_EQ(answer.at("error").at("code"), "preset_off");
    // Of a lamp wholly wrong, by the factor less the walls' part, which stays.
    EXPECT_GT(answer.at("rms_relative").get<double>(), 0.5 * std::abs(factor - 1.0)) << factor;
    EXPECT_EQ(Answer({"check", spoilt(changed), "--session", session, "--strict"}, 1).exit_code, 1);
  }
  EXPECT_GT(lights.size(), 1U);
  json renamed = gltf;
  for (json& node : renamed["nodes"]) {
    if (node.value("name", "") == "key2") node["name"] = "other";
  }
  for (json& light : renamed["extensions"]["KHR_lights_punctual"]["lights"]) {
    if (light.value("name", "") == "key2") light["name"] = "other";
  }
  const json missing =
      json::parse(Answer({"check", spoilt(renamed), "--session", session, "--json"}, 1).out);
  EXPECT_EQ(missing.at("missing"), json({"key2"}));
  EXPECT_EQ(missing.at("error").at("code"), "missing_lights");
  // Half as bright is half off; who allows 90 % gets 0.
  json half = gltf;
  for (json& light : half["extensions"]["KHR_lights_punctual"]["lights"]) {
    light["intensity"] = light["intensity"].get<double>() * 0.5;
  }
  Answer({"check", spoilt(half), "--session", session, "--max-error", "90%"}, 0);
}

// ---- names ----

// A session names files of its own folder; more only where the person says so.
TEST_F(StrangersFiles, ASessionOpensNothingOutsideOfItsFolder) {
  const std::string secret = folder_.Write(
      "home/secret.csv", "wavelength_nm,relative\n" + [] {
        std::string rows;
        for (int nm = 380; nm <= 780; nm += 5) rows += std::to_string(nm) + ",1\n";
        return rows;
      }());
  const auto session = [&](const std::string& spectrum) {
    folder_.Write("s/session.toml",
                  "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n[[reading]]\n"
                  "light = \"key\"\ndistance_m = 1\nilluminance_lx = 52\nspectrum = \"" +
                      spectrum + "\"\n");
    return folder_.path() + "/s";
  };
  fs::create_directories(folder_.path() + "/s/captures");
  fs::create_symlink(secret, folder_.path() + "/s/captures/link.csv");
  for (const std::string& spectrum :
       {secret, std::string("../home/secret.csv"), std::string("captures/link.csv"),
        std::string("captures/../../home/secret.csv")}) {
    const std::string path = session(spectrum);
    for (const char* command : {"fit", "run", "explain"}) {
      const CliResult refused = Answer({command, path, "--json"}, 3);
      EXPECT_THAT(refused.out, HasSubstr("outside_session")) << command << " " << spectrum;
    }
    Answer({"fit", path, "--allow-outside", "--force"}, 0);
    Answer({"run", path, "--allow-outside", "--force"}, 0);
  }
  // Several sessions at once, each in a process of its own, as one alone.
  const std::string both = session(secret);
  fs::create_directory(folder_.path() + "/t");
  fs::copy_file(both + "/session.toml", folder_.path() + "/t/session.toml");
  Answer({"run", both, folder_.path() + "/t"}, 3);
  Answer({"run", both, folder_.path() + "/t", "--allow-outside", "--force"}, 0);
  EXPECT_THAT(Answer({"state", both, "--json"}, 3).out, HasSubstr("outside_session"));
  fs::copy_file(secret, folder_.path() + "/s/captures/own.csv");
  Answer({"fit", session("captures/own.csv"), "--force"}, 0);
  // A folder that the person's own settings name, and none that only begins like it.
  folder_.Write("config/lightcal/config.toml", "roots = [\"" + folder_.path() + "/home\"]\n");
  const std::vector<std::string> settings = {"XDG_CONFIG_HOME=" + folder_.path() + "/config"};
  EXPECT_EQ(RunLightcal({"fit", session(secret), "--force"}, "", settings).exit_code, 0);
  folder_.Write("config/lightcal/config.toml", "roots = [\"" + folder_.path() + "/ho\"]\n");
  EXPECT_EQ(RunLightcal({"fit", session(secret), "--force"}, "", settings).exit_code, 3);
  folder_.Write("config/lightcal/config.toml", "roots = [\"home\"]\n");
  EXPECT_THAT(RunLightcal({"fit", session(secret), "--json"}, "", settings).out,
              HasSubstr("bad_config"));
}

// `cp -r` of a sample is a session.
TEST_F(StrangersFiles, EverySampleSessionRunsFromACopyOfItsFolder) {
  for (const auto& entry : fs::directory_iterator(SampleData("sessions"))) {
    const std::string copy = folder_.path() + "/" + entry.path().filename().string();
    fs::copy(entry.path(), copy, fs::copy_options::recursive);
    Answer({"fit", copy, "-o", copy + "/light.json"}, 0);
  }
}

TEST_F(StrangersFiles, ANameIsNoPath) {
  const std::string deep = folder_.path() + "/a/b/p";
  for (const char* name : {"../../evil", "/tmp/lightcal-evil"}) {  // as in a session
    Answer({"quick", "192lx@0.5m", "--name", name, "--to", "gltf,ies", "-o", deep}, 3);
  }
  EXPECT_EQ(Files(), 0U);
  for (const char* name : {"..", ".hidden"}) {
    Answer({"quick", "192lx@0.5m", "--name", name, "--to", "gltf,ies", "-o", deep}, 0);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(entry.path().parent_path(), fs::path(deep));
  }
  EXPECT_GE(Files(), 4U);
  EXPECT_FALSE(fs::exists("/tmp/lightcal-evil.gltf"));
}

TEST_F(StrangersFiles, NothingInAFileOrANameSteersATerminal) {
  const std::string red = "a\x1b[31mb";
  const std::string turned =
      "gpj\xE2\x80\xAE"
      "exe";
  for (const std::string& name : {red, turned,
                                  std::string("c1\xC2\x9B"
                                              "31m")}) {
    const CliResult quick = Answer({"quick", "192lx@0.5m", "--name", name}, 2);
    EXPECT_THAT(quick.err, HasSubstr("\\u"));
    const std::string toml = folder_.Write("s/session.toml", SessionToml(name));
    Answer({"fit", folder_.path() + "/s"}, 3);
    const int absent = name == red ? 3 : 1;  // its bracket makes a wildcard of it
    Answer({"run", folder_.path() + "/" + name}, absent);
    Answer({"fit", folder_.path() + "/" + name, "--json"}, 1);
    json light = json::parse(ReadFile(SampleData("lights/desk_lamp_june.json")));
    light["lights"][0]["name"] = name;
    const std::string file = folder_.Write("light.json", light.dump());
    Answer({"export", file, "--to", "gltf", "-o", folder_.path() + "/p"}, 3);
    Answer({"report", file}, 3);
  }
}

// ---- a folder of sessions is one level ----

TEST_F(StrangersFiles, RunOfAFolderDoesNotWorkThroughADisk) {
  folder_.Write("d/near/session.toml", SessionToml("key"));
  folder_.Write("d/x/deep/session.toml", SessionToml("key"));
  const std::size_t before = Files();
  const CliResult refused = Answer({"run", folder_.path() + "/d"}, 3);
  EXPECT_THAT(refused.err, HasSubstr("/d/x/deep"));
  EXPECT_THAT(refused.err, HasSubstr("--recursive"));
  EXPECT_EQ(Files(), before);
  Answer({"run", folder_.path() + "/d/x", "--to", "gltf"}, 0);
  EXPECT_TRUE(fs::exists(folder_.path() + "/d/x/deep/out/deep.gltf"));
  Answer({"run", folder_.path() + "/d", "--recursive", "--to", "gltf"}, 0);
  EXPECT_TRUE(fs::exists(folder_.path() + "/d/near/out/near.gltf"));
}

// ---- messages ----

TEST_F(StrangersFiles, ExportTakesASession) {
  const std::string session = folder_.path() + "/lamp one";
  folder_.Write("lamp one/session.toml", SessionToml("key"));
  EXPECT_THAT(Answer({"export", session, "--to", "gltf", "-o", folder_.path() + "/p"}, 3).err,
              HasSubstr("lightcal run '" + session + "'"));
  ASSERT_EQ(RunLightcal({"run", session, "--to", "json"}).exit_code, 0);
  Answer({"export", session, "--to", "gltf", "-o", folder_.path() + "/p"}, 0);
  EXPECT_TRUE(fs::exists(folder_.path() + "/p/lamp one.gltf"));
}

TEST_F(StrangersFiles, SlipsAreNamed) {
  EXPECT_THAT(Answer({"quick", "1e300lx@1m"}, 3).err, HasSubstr("so many lux"));
  EXPECT_THAT(Answer({"quick", "192,5lx@1m"}, 2).err, HasSubstr("192.5lx@1m"));
  EXPECT_THAT(Answer({"quick", "192.5lx@0,5m"}, 2).err, HasSubstr("192.5lx@0.5m"));
  EXPECT_THAT(Answer({"quick", "203,5lx@0,5m"}, 2).err, HasSubstr("203.5lx@0.5m"));
  EXPECT_THAT(Answer({"quick", "0,125lx@0.5m"}, 2).err, Not(HasSubstr("0125lx")));
  const std::string thousands = Answer({"quick", "1,203lx@0.5m,card=5lx"}, 2).err;
  EXPECT_THAT(thousands, HasSubstr("1.203lx@0.5m,card=5lx"));
  EXPECT_THAT(thousands, HasSubstr("1203lx@0.5m,card=5lx"));
  EXPECT_EQ(Answer({"quick", "192lx@1m,2900K"}, 0).exit_code, 0);
  folder_.Write("s/session.toml", SessionToml("key"));
  const std::string session = folder_.path() + "/s";
  const CliResult knob = Answer({"tradeoff", session, "--knobs", "foo"}, 2);
  EXPECT_THAT(knob.err, Not(HasSubstr("\"\"")));
  EXPECT_THAT(knob.err, HasSubstr("solver"));
  const std::string broken = folder_.Write("b.gltf", "{\"asset\": {}, \"nodes\": 3}");
  EXPECT_THAT(Answer({"check", broken, "--session", session}, 3).err, HasSubstr("b.gltf"));
  const CliResult printed = Answer({"read", "--once", "--device", "line:!echo hello"}, 1);
  EXPECT_THAT(printed.err, HasSubstr("hello\""));
}

TEST_F(StrangersFiles, WhatNoLightIsIsRefused) {
  EXPECT_THAT(Answer({"convert", "60W", "--efficacy", "900lm/W", "--kind", "point"}, 3).err,
              HasSubstr("683"));
  Answer({"convert", "60W", "--efficacy", "200lm/W", "--kind", "point"}, 0);
  EXPECT_THAT(Answer({"color", "--xy", "44.76", "40.74"}, 3).err, HasSubstr("parts of one"));
}

TEST_F(StrangersFiles, TheAccuracyThatNewWasToldIsThatOfATypedReading) {
  const std::string session = folder_.path() + "/lamp";
  ASSERT_EQ(RunLightcal({"new", session, "--meter", "none", "--accuracy", "3%", "--yes"}).exit_code,
            0);
  Answer({"read", "-s", session, "--light", "key", "--distance", "1m", "--lux", "100"}, 0);
  EXPECT_EQ(json::parse(ReadFile(session + "/readings.jsonl")).value("meter", ""), "my_meter");
}

TEST_F(StrangersFiles, APipeThatNobodyWritesToIsGivenUp) {
  const std::string pipe = folder_.path() + "/pipe.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Answer({"color", "--spectrum", pipe}, 1);
  Answer({"merge", pipe, "-o", folder_.path() + "/x.exr"}, 1);
  // One that is written to is read: a shell's <(...) is such a pipe.
  const CliResult writer = RunProgram(
      {"bash", "-c",
       "(printf 'wavelength_nm,relative\\n380,1\\n780,1\\n' > \"$0\") > /dev/null 2>&1 &", pipe});
  ASSERT_EQ(writer.exit_code, 0);
  EXPECT_THAT(Answer({"color", "--spectrum", pipe}, 0).out, HasSubstr("CCT"));
}

}  // namespace
}  // namespace lightcal::test
