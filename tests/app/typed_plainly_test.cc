// SPDX-License-Identifier: Apache-2.0
// What people type who have not read --help: values without an option's name, a file's name where a
// directory goes, one word too many.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "expect_says.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using ::testing::HasSubstr;
using Words = std::vector<std::string>;

TEST(TypedPlainly, AColourNeedsNoOption) {
  const auto same = [](const Words& plain, const Words& named) {
    EXPECT_EQ(LightcalJson("color", plain), LightcalJson("color", named)) << plain.front();
  };
  same({"3200K"}, {"--cct", "3200"});
  same({"3200", "--duv", "0.003"}, {"--cct", "3200", "--duv", "0.003"});
  same({"0.33,0.34"}, {"--xy", "0.33", "0.34"});
  same({"0.33", "0.34"}, {"--xy", "0.33", "0.34"});
  same({"95,100,108"}, {"--xyz", "95", "100", "108"});
  same({"illuminant:FL11"}, {"--spectrum", "illuminant:FL11"});
  ExpectSays({"color", "3200K", "--cct", "3200"}, 2, "give one colour");
  ExpectSays({"color", "3200K", "0.33,0.34"}, 2, "give one colour");
  ExpectSays({"color", "1,2,3,4"}, 1, "there is no such file");
  ExpectSays({"color", "a,b.csv"}, 1, "there is no such file");
}

TEST(TypedPlainly, ACameraIsTypedAsItShowsItsSettings) {
  const Words named = {"--aperture", "2.8", "--shutter", "1/60", "--iso", "400"};
  EXPECT_EQ(LightcalJson("exposure", {"1/60", "f/2.8", "ISO400"}), LightcalJson("exposure", named));
  EXPECT_EQ(LightcalJson("exposure", {"F2.8", "iso400", "--shutter", "1/60"}),
            LightcalJson("exposure", named));
  EXPECT_EQ(LightcalJson("exposure", {"T2.9", "180deg", "24fps", "ISO800"}),
            LightcalJson("exposure",
                         {"--t-stop", "2.9", "--angle", "180", "--fps", "24", "--iso", "800"}));
  ExpectSays({"exposure", "f2.8", "60", "ISO400"}, 2, "write f/60, 1/60 or ISO60");
  ExpectSays({"exposure", "f2.8", "f4", "1/60", "ISO400"}, 2, "give it once");
  ExpectSays({"exposure", "f2.8", "--aperture", "4", "1/60", "ISO400"}, 2, "give it once");
  ExpectSays({"exposure", "f2.8", "1/60", "ISO400", "lens"}, 2, "is no setting");
}

TEST(TypedPlainly, AReadingWithoutADistanceIsToldItsOption) {
  ExpectSays({"quick", "5000K", "300lx@1m"}, 2, "--cct 5000K");
  ExpectSays({"quick", "806lm"}, 2, "--lumens 806lm");
  ExpectSays({"quick", "9W"}, 2, "--watts 9W");
  ExpectSays({"quick", "192lx@0.5m", "--at", "3m", "5m"}, 2, "its own --at 5m");
  ExpectSays({"match", "illuminant:A", "--to", "3200"}, 1, "the colour temperature is 3200K");
}

TEST(TypedPlainly, OneWordTooManyIsNamed) {
  ExpectSays({"photometric", "a.ldt", "b.ldt"}, 2, "b.ldt: one word too many: file is a.ldt");
  ExpectSays({"convert", "806lm", "3"}, 2, "3: one word too many: value is 806lm");
}

TEST(TypedPlainly, ADirectoryIsNotNamedAsAFile) {
  const TempDir folder;
  const std::string light = SampleData("lights/desk_lamp_june.json");
  const std::string file = folder.path() + "/lamp.gltf";
  ExpectSays({"export", light, "--to", "gltf", "-o", file}, 2, "leave the ending out");
  ExpectSays({"quick", "100lx@1m", "--to", "gltf", "-o", file}, 2, "leave the ending out");
  ExpectSays({"run", SampleData("sessions/three_real_lights"), "-o", file}, 2,
             "leave the ending out");
  EXPECT_FALSE(std::filesystem::exists(file));
  // One that is there is meant.
  std::filesystem::create_directory(file);
  EXPECT_EQ(RunLightcal({"export", light, "--to", "gltf", "-o", file}).exit_code, 0);
  // A point in a name is no ending.
  EXPECT_EQ(RunLightcal({"export", light, "--to", "gltf", "-o", folder.path() + "/v1.2"}).exit_code,
            0);
}

TEST(TypedPlainly, AFolderOfOutputsIsValidatedFileByFile) {
  const TempDir folder;
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"run", SampleData("sessions/three_real_lights"), "-o", out}).exit_code, 0);
  const auto document = LightcalJson("validate", {out});
  std::vector<std::string> formats;
  for (const auto& file : document["files"]) {
    EXPECT_TRUE(file["ok"]) << file;
    formats.push_back(file["format"]);
  }
  EXPECT_THAT(formats,
              ::testing::IsSupersetOf({"light", "preset", "IES", "EULUMDAT", "engine file"}));
  std::filesystem::remove_all(out);
  std::filesystem::create_directory(out);
  EXPECT_EQ(RunLightcal({"validate", out}).exit_code, 1) << "no session, nothing else";
}

TEST(TypedPlainly, TwoReadingsTypedWithinASecondAreTwo) {
  const TempDir folder;
  const std::string session = folder.path() + "/hall";
  ASSERT_EQ(RunLightcal({"new", session, "--box", "806lm", "--yes"}).exit_code, 0);
  for (const auto& [metres, lux] : {std::pair("1m", "60"), std::pair("2m", "17")}) {
    ASSERT_EQ(RunLightcal({"read", "-s", session, "--distance", metres, "--lux", lux}).exit_code,
              0);
  }
  const CliResult fit = RunLightcal({"fit", session, "-q"});
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.err, ::testing::Not(HasSubstr("the very time")));
}

TEST(TypedPlainly, ATableMayHaveDecimalCommas) {
  const TempDir folder;
  const auto answer = [&](const std::string& table) {
    auto document = LightcalJson("quick", {"--table", folder.Write("t.csv", table)});
    return document["lights"];
  };
  const auto points = answer("lamp,distance_m,lux,cct_K\nkey,1.5,300.2,3200.5\n");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(answer("lamp;distance (m);lux;cct_K\nkey;1,5;300,2;3200,5\n"), points);
  EXPECT_EQ(answer("lamp\tdistance (m)\tlux\tcct_K\nkey\t1,5\t300,2\t3200,5\n"), points);
  // Commas between the columns leave none for decimals.
  ExpectSays({"quick", "--table", folder.Write("t.csv", "lamp,distance_m,lux\nkey,\"1,5\",300\n")},
             3, "\"1,5\" is not a number");
  ExpectSays({"quick", "--table", folder.Write("t.csv", "lamp,lux,Distance\nkey,300,1\n")}, 3,
             "\"Distance\" has no unit");
}

TEST(TypedPlainly, AFolderOfFramesIsToldHowToBeNamed) {
  const TempDir folder;
  ExpectSays({"merge", folder.path(), "-o", folder.path() + "/out.exr"}, 1, folder.path() + "/*");
}

TEST(TypedPlainly, ALibraryIsSearchedByAName) {
  const TempDir folder;
  const std::string library = folder.path() + "/library";
  ASSERT_EQ(
      RunLightcal({"lights", "--library", library, "add", SampleData("lights/desk_lamp_june.json")})
          .exit_code,
      0);
  EXPECT_EQ(LightcalJson("lights", {"--library", library, "list", "desk"})["lights"].size(), 1U);
  EXPECT_EQ(LightcalJson("lights", {"--library", library, "list", "sun"})["lights"].size(), 0U);
}

TEST(TypedPlainly, WhatAnIncidentMeterShowsIsAnsweredWithTheLux) {
  const CliResult quick = RunLightcal({"quick", "EV10@1m"});
  EXPECT_EQ(quick.exit_code, 2);
  EXPECT_THAT(quick.err, HasSubstr("2560 lx under its flat receptor"));
  EXPECT_THAT(RunLightcal({"quick", "f/4@1m"}).err, HasSubstr("set the meter to lux"));
}

// Not "was it another lamp's?": one place was read twice.
TEST(TypedPlainly, ALampThatWarmsUpIsNoOtherLamp) {
  const CliResult quick = RunLightcal(
      {"quick", "421lx@0.5m", "130.7lx@1m", "51.7lx@2m", "474lx@0.5m", "--fixture", "bulb"});
  EXPECT_EQ(quick.exit_code, 3);
  EXPECT_THAT(quick.err, HasSubstr("421.0, 474.0 lx (readings 0, 3)"));
  EXPECT_THAT(quick.err, HasSubstr("warming up"));
}

}  // namespace
}  // namespace lightcal::test
