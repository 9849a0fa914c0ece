// SPDX-License-Identifier: Apache-2.0
// lightcal convert, driven as a shell would.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "expect_says.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

test::CliResult Convert(Words words, const Words& environment = {}) {
  words.insert(words.begin(), "convert");
  return test::RunLightcal(words, "", environment);
}

json ConvertJson(const Words& words) { return test::LightcalJson("convert", words); }

void ExpectRefusal(Words words, int exit_code, const std::string& says) {
  words.insert(words.begin(), "convert");
  test::ExpectSays(words, exit_code, says);
}

TEST(ConvertCommand, GivesTheSeedsExampleWithAllItsDigits) {
  const json answer = ConvertJson({"60W", "--efficacy", "10lm/W", "--kind", "point", "--distance",
                                   "0.5m", "--reflectance", "0.9"});
  EXPECT_NEAR(answer["flux_lm"], 600.0, 1e-9);
  EXPECT_NEAR(answer["intensity_cd"], 600.0 / (4.0 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(answer["intensity_cd"], 47.746, 5e-4);
  EXPECT_NEAR(answer["illuminance_lx"], 190.986, 5e-4);
  EXPECT_NEAR(answer["exitance_lm_m2"], 171.887, 5e-4);
  EXPECT_NEAR(answer["luminance_nits"], 54.713, 5e-4);
  EXPECT_NEAR(answer["electrical_W"], 60.0, 1e-12);
}

TEST(ConvertCommand, PrintsATableWithUnits) {
  const test::CliResult run =
      Convert({"60W", "--efficacy", "10lm/W", "--kind", "point", "--distance", "0.5m"});
  EXPECT_EQ(run.exit_code, 0);
  for (const char* text : {"47.7465  cd", "190.986  lx", "600.000  lm", "quantity"}) {
    EXPECT_NE(run.out.find(text), std::string::npos) << run.out;
  }
  EXPECT_EQ(run.err, "");
}

TEST(ConvertCommand, AcceptsEveryUnitPeopleType) {
  const auto flux = [](const char* value) {
    return ConvertJson(
               {value, "--kind", "disk", "--diameter", "20cm", "--distance", "1m"})["flux_lm"]
        .get<double>();
  };
  EXPECT_NEAR(flux("0.5klm"), 500.0, 1e-9);
  EXPECT_NEAR(flux("2cd"), 2.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(flux("1500 nits"), flux("1500cd/m2"), 1e-12);
  EXPECT_NEAR(flux("1500nits"), flux("1500cd/m²"), 1e-12);
  EXPECT_NEAR(flux("1fc") / flux("1lx"), 10.7639, 1e-4);
  EXPECT_NEAR(flux("1fL") / flux("1nit"), 3.42626, 1e-5);
  EXPECT_NEAR(flux("314.159265lm/m2") / flux("100nits"), 1.0, 1e-8);
}

TEST(ConvertCommand, LeavesOutWhatAKindDoesNotHave) {
  const auto keys = [](const Words& words) {
    std::set<std::string> found;
    const json answer = ConvertJson(words);
    for (const auto& [key, value] : answer.items()) found.insert(key);
    return found;
  };
  using Keys = std::set<std::string>;
  EXPECT_EQ(keys({"806lm", "--kind", "point"}), (Keys{"flux_lm", "intensity_cd"}));
  EXPECT_EQ(keys({"98klx", "--kind", "directional"}), (Keys{"illuminance_lx"}));
  EXPECT_EQ(
      keys({"1500nits", "--kind", "rect", "--size", "120x60cm", "--distance", "3m"}),
      (Keys{"flux_lm", "intensity_cd", "illuminance_lx", "luminance_nits", "exitance_lm_m2"}));
  EXPECT_EQ(keys({"5000nits", "--kind", "dome"}),
            (Keys{"illuminance_lx", "luminance_nits", "exitance_lm_m2"}));
}

TEST(ConvertCommand, KeepsLampAndLitSurfaceApart) {
  const json answer = ConvertJson({"1000nits", "--kind", "rect", "--width", "1m", "--height", "1m",
                                   "--distance", "5m", "--reflectance", "0.5"});
  EXPECT_NEAR(answer["source_luminance_nits"], 1000.0, 1e-9);
  EXPECT_NEAR(answer["source_exitance_lm_m2"], 1000.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(answer["exitance_lm_m2"].get<double>(), 0.5 * answer["illuminance_lx"].get<double>(),
              1e-12);
}

TEST(ConvertCommand, ReadsHalfAnglesAndFullAnglesWhenAsked) {
  const json half = ConvertJson({"806lm", "--kind", "spot", "--inner", "20", "--outer", "35"});
  const json full =
      ConvertJson({"806lm", "--kind", "spot", "--inner", "40", "--outer", "70", "--full-angles"});
  EXPECT_EQ(half, full);
  EXPECT_NEAR(half["intensity_cd"], 1276.56, 0.01);
}

TEST(ConvertCommand, KnowsTheFiveMeaningsOfASpotsLumens) {
  const auto intensity = [](const char* falloff) {
    return ConvertJson({"1000lm", "--kind", "spot", "--inner", "15", "--outer", "25",
                        "--spot-falloff", falloff})["intensity_cd"]
        .get<double>();
  };
  EXPECT_NEAR(1000.0 / intensity("hard"), 0.589, 5e-4);
  EXPECT_NEAR(1000.0 / intensity("squared"), 0.339, 5e-4);
  EXPECT_NEAR(1000.0 / intensity("smoothstep"), 0.401, 5e-4);
  EXPECT_EQ(intensity("linear"), intensity("smoothstep"));
  EXPECT_NEAR(1000.0 / intensity("pi"), std::numbers::pi, 1e-12);
}

TEST(ConvertCommand, WarnsWhenTheInnerAngleIsTheWiderAndRefusesWhenStrict) {
  const Words words = {"806lm", "--kind", "spot", "--inner", "40", "--outer", "35"};
  const json answer = ConvertJson(words);
  EXPECT_EQ(answer["warnings"][0]["code"], "inner_beyond_outer");
  Words strict = words;
  strict.emplace_back("--strict");
  ExpectRefusal(strict, 3, "inner angle");
}

TEST(ConvertCommand, TeachesWhenTheCommandLineIsWrong) {
  ExpectRefusal({"806", "--kind", "point"}, 2, "a unit is needed");
  ExpectRefusal({"806lumen", "--kind", "point"}, 2, "unknown unit \"lumen\"");
  ExpectRefusal({"lm", "--kind", "point"}, 2, "a number is needed");
  ExpectRefusal({"nanlm", "--kind", "point"}, 2, "a number is needed");
  ExpectRefusal({"806lm"}, 2, "--kind point");
  ExpectRefusal({"806lm", "--kind", "pont"}, 2, "did you mean point");
  ExpectRefusal({"60W", "--kind", "point"}, 2, "watts are electrical power");
  ExpectRefusal({"60W", "--kind", "point", "--efficacy", "10lx"}, 2, "lm/w");
  ExpectRefusal({"190lx", "--kind", "point"}, 2, "needs the distance");
  ExpectRefusal({"190lx", "--kind", "point", "--distance", "3lx"}, 2, "length");
  ExpectRefusal({"806lm", "--kind", "sphere"}, 2, "radius or diameter");
  ExpectRefusal({"806lm", "--kind", "sphere", "--radius", "1", "--diameter", "2"}, 2, "not both");
  ExpectRefusal({"806lm", "--kind", "rect", "--size", "1m"}, 2, "WIDTHxHEIGHT");
  ExpectRefusal({"806lm", "--kind", "rect", "--size", "1x1m", "--width", "1m"}, 2, "not both");
  ExpectRefusal({"806lm", "--kind", "spot"}, 2, "--outer 35");
  ExpectRefusal({"806lm", "--kind", "spot", "--outer", "35", "--spot-falloff", "cubic"}, 2,
                "squared, linear");
  ExpectRefusal({"806lm", "--kind", "directional"}, 2, "illuminance, in lx");
  ExpectRefusal({"806lm", "--kind", "photometric"}, 2, "lightcal photometric");
  ExpectRefusal({"806lm", "--kind", "point", "--reflectance", "0.5"}, 2, "--distance");
  ExpectRefusal({"806lm", "--kind", "point", "--distance", "1m", "--reflectance", "white"}, 2,
                "not a number");
}

TEST(ConvertCommand, RefusesWhatCannotBe) {
  ExpectRefusal({"0lm", "--kind", "point"}, 3, "above zero");
  ExpectRefusal({"-806lm", "--kind", "point"}, 3, "above zero");
  ExpectRefusal({"-60W", "--kind", "point", "--efficacy", "10"}, 3, "above zero");
  ExpectRefusal({"60W", "--kind", "point", "--efficacy", "0"}, 3, "above zero");
  ExpectRefusal({"806lm", "--kind", "point", "--distance", "0"}, 3, "above zero");
  ExpectRefusal({"806lm", "--kind", "point", "--distance", "-1m"}, 3, "above zero");
  ExpectRefusal({"806lm", "--kind", "sphere", "--radius", "0"}, 3, "above zero");
  ExpectRefusal({"806lm", "--kind", "sphere", "--radius", "1m", "--distance", "0.5m"}, 3, "inside");
  ExpectRefusal({"806lm", "--kind", "spot", "--outer", "0"}, 3, "half angle");
  ExpectRefusal({"806lm", "--kind", "spot", "--outer", "181"}, 3, "180");
  ExpectRefusal({"806lm", "--kind", "point", "--distance", "1m", "--reflectance", "1.1"}, 3,
                "up to 1");
  ExpectRefusal({"1e300lm", "--kind", "point", "--distance", "1e-6m"}, 3, "range");
}

TEST(ConvertCommand, AnErrorIsJsonToo) {
  const test::CliResult run = Convert({"0lm", "--kind", "point", "--json"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(json::parse(run.out)["error"]["code"], "not_positive");
}

TEST(ConvertCommand, SpeaksTheSameInEveryLocale) {
  const Words words = {"60.5W", "--efficacy", "10.5lm/W", "--kind", "point", "--distance", "0.5m"};
  const std::string plain = Convert(words, {"LC_ALL=C"}).out;
  EXPECT_NE(plain.find("635.250"), std::string::npos) << plain;
  for (const char* locale : {"LC_ALL=de_DE.UTF-8", "LC_ALL=fr_FR.UTF-8", "LC_ALL=C.UTF-8"}) {
    EXPECT_EQ(Convert(words, {locale}).out, plain);
  }
}

TEST(ConvertCommand, HelpSaysThatWattsAreElectricalAndShowsAnExample) {
  const test::CliResult run = Convert({"--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("never radiant"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("lightcal convert 60W --efficacy 10lm/W"), std::string::npos) << run.out;
}

TEST(ConvertCommand, WhatSaysNothingOfTheLampIsWarnedOf) {
  const json document = ConvertJson({"100cd", "--kind", "point", "--inner", "20"});
  ASSERT_EQ(document["warnings"].size(), 1U);
  EXPECT_EQ(document["warnings"][0]["code"], "unused_option");
  EXPECT_EQ(document["warnings"][0]["subject"], "--inner");
  EXPECT_FALSE(ConvertJson({"100cd", "--kind", "spot", "--inner", "20", "--outer", "30"})
                   .contains("warnings"));
}

}  // namespace
}  // namespace lightcal
