// SPDX-License-Identifier: Apache-2.0
// lightcal exposure, driven as a shell would.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "expect_says.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

test::CliResult Exposure(Words words) {
  words.insert(words.begin(), "exposure");
  return test::RunLightcal(words);
}

json ExposureJson(const Words& words) { return test::LightcalJson("exposure", words); }

void ExpectExposureRefused(Words words, int exit_code, const std::string& says) {
  words.insert(words.begin(), "exposure");
  test::ExpectSays(words, exit_code, says);
}

TEST(ExposureCommand, GivesEvAndTheSaturatingLuminance) {
  const json answer = ExposureJson({"--aperture", "f/16", "--shutter", "1/64", "--iso", "100"});
  EXPECT_NEAR(answer["ev"], 14.0, 1e-12);
  EXPECT_NEAR(answer["ev100"], 14.0, 1e-12);
  EXPECT_NEAR(answer["l_max_nits"], 1.2 * 16384.0, 1e-9);
  EXPECT_NEAR(answer["exposure"], 1.0 / (1.2 * 16384.0), 1e-18);
}

TEST(ExposureCommand, TwiceTheSpeedTakesOneFromEv100AndHalvesTheMaximum) {
  const json slow = ExposureJson({"--aperture", "2.8", "--shutter", "1/50", "--iso", "100"});
  const json fast = ExposureJson({"--aperture", "2.8", "--shutter", "1/50", "--iso", "200"});
  EXPECT_EQ(slow["ev"], fast["ev"]);
  EXPECT_NEAR(slow["ev100"].get<double>() - fast["ev100"].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(slow["l_max_nits"].get<double>() / fast["l_max_nits"].get<double>(), 2.0, 1e-12);
}

TEST(ExposureCommand, AShutterAngleIsATime) {
  const json angle =
      ExposureJson({"--aperture", "f/2.8", "--angle", "180", "--fps", "24", "--iso", "800"});
  const json time = ExposureJson({"--aperture", "f/2.8", "--shutter", "1/48", "--iso", "800"});
  EXPECT_NEAR(angle["ev"].get<double>(), time["ev"].get<double>(), 1e-12);
  EXPECT_NEAR(angle["shutter_s"], 1.0 / 48.0, 1e-15);
}

TEST(ExposureCommand, LensFactorsReplaceTheStandardConstant) {
  const Words base = {"--aperture", "4", "--shutter", "1/60", "--iso", "100"};
  EXPECT_EQ(ExposureJson(base)["q"], 0.65);
  Words perfect = base;
  perfect.insert(perfect.end(),
                 {"--transmittance", "1", "--vignetting", "1", "--field-angle", "0"});
  EXPECT_NEAR(ExposureJson(perfect)["q"], std::numbers::pi / 4.0, 1e-15);
  Words edge = base;
  edge.insert(edge.end(), {"--field-angle", "30"});
  EXPECT_NEAR(ExposureJson(edge)["q"], std::numbers::pi / 4.0 * 0.9 * 0.98 * 9.0 / 16.0, 1e-12);
}

// T/2 of a lens that passes 90 % is f/1.897: the same light on the sensor.
TEST(ExposureCommand, ATStopHasItsTransmittanceInIt) {
  const json t = ExposureJson({"--t-stop", "T2", "--shutter", "1/60", "--iso", "100"});
  const json f = ExposureJson(
      {"--aperture", std::to_string(2.0 * std::sqrt(0.9)), "--shutter", "1/60", "--iso", "100"});
  EXPECT_NEAR(t["l_max_nits"].get<double>() / f["l_max_nits"].get<double>(), 1.0, 1e-6);
}

TEST(ExposureCommand, SaysWhichLightsFitAHalfFloat) {
  const json answer = ExposureJson({"--aperture", "f/16", "--shutter", "1/64", "--iso", "100",
                                    "--light", "2e9nits", "100klx", "1lx", "1e-4cd"});
  const json& lights = answer["lights"];
  EXPECT_NEAR(lights[0]["pre_exposed"], 101725.0, 1.0);
  EXPECT_EQ(lights[0]["fits_fp16"], false);
  EXPECT_NEAR(lights[1]["pre_exposed"], 1e5 / 19660.8, 1e-9);
  EXPECT_EQ(lights[1]["fits_fp16"], true);
  EXPECT_EQ(lights[2]["fp16"], "subnormal");
  EXPECT_EQ(lights[3]["fp16"], "underflow");
  EXPECT_EQ(lights[3]["fits_fp16"], false);
  EXPECT_EQ(answer["warnings"].size(), 3U);
  EXPECT_EQ(answer["warnings"][0]["code"], "fp16_overflow");
  EXPECT_EQ(ExposureJson({"--aperture", "f/16", "--shutter", "1/64", "--iso", "100", "--light",
                          "2e9nits,100klx,1lx", "1e-4cd"}),
            answer);
  const json darker = ExposureJson(
      {"--aperture", "f/16", "--shutter", "1/128", "--iso", "100", "--light", "2e9nits"});
  EXPECT_NEAR(darker["lights"][0]["pre_exposed"], 50863.0, 1.0);
  EXPECT_EQ(darker["lights"][0]["fits_fp16"], true);
}

TEST(ExposureCommand, StrictRefusesALightThatDoesNotFit) {
  ExpectExposureRefused(
      {"--aperture", "f/16", "--shutter", "1/64", "--iso", "100", "--light", "2e9nits", "--strict"},
      3, "65504");
}

TEST(ExposureCommand, PrintsATableWithUnitsAndTheLights) {
  const test::CliResult run =
      Exposure({"--aperture", "f/16", "--shutter", "1/64", "--iso", "100", "--light", "100klx"});
  for (const char* text : {"19660.8  cd/m²", "0.650000", "100klx", "fits"}) {
    EXPECT_NE(run.out.find(text), std::string::npos) << run.out;
  }
}

TEST(ExposureCommand, NotesThatABareShutterOfSixtyIsSeconds) {
  const test::CliResult run = Exposure({"--aperture", "8", "--shutter", "60", "--iso", "100"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("1/60"), std::string::npos) << run.err;
}

TEST(ExposureCommand, TeachesWhenTheCommandLineIsWrong) {
  ExpectExposureRefused({"--shutter", "1/60", "--iso", "100"}, 2, "--aperture f/2.8");
  ExpectExposureRefused({"--aperture", "2", "--t-stop", "2", "--shutter", "1/60", "--iso", "100"},
                        2, "once");
  ExpectExposureRefused({"--aperture", "2", "--iso", "100"}, 2, "--shutter 1/60");
  ExpectExposureRefused({"--aperture", "2", "--shutter", "1/60", "--angle", "180", "--iso", "100"},
                        2, "once");
  ExpectExposureRefused({"--aperture", "2", "--angle", "180", "--iso", "100"}, 2, "together");
  ExpectExposureRefused({"--aperture", "2", "--fps", "24", "--iso", "100"}, 2, "together");
  ExpectExposureRefused({"--aperture", "2", "--shutter", "1/60"}, 2, "--iso 100");
  ExpectExposureRefused({"--aperture", "wide", "--shutter", "1/60", "--iso", "100"}, 2,
                        "not a number");
  ExpectExposureRefused({"--aperture", "2", "--shutter", "1/0", "--iso", "100"}, 2, "number");
  ExpectExposureRefused({"--aperture", "2", "--shutter", "1/60lx", "--iso", "100"}, 2, "time");
  ExpectExposureRefused(
      {"--t-stop", "2", "--transmittance", "0.9", "--shutter", "1/60", "--iso", "100"}, 2,
      "includes");
  ExpectExposureRefused({"--aperture", "2", "--shutter", "1/60", "--iso", "100", "--light", "60W"},
                        2, "watts are not light");
}

TEST(ExposureCommand, RefusesWhatCannotBe) {
  const auto with = [](const char* aperture, const char* shutter, const char* iso) {
    return Words{"--aperture", aperture, "--shutter", shutter, "--iso", iso};
  };
  ExpectExposureRefused(with("0", "1/60", "100"), 3, "above zero");
  ExpectExposureRefused(with("-2", "1/60", "100"), 3, "above zero");
  ExpectExposureRefused(with("2", "0", "100"), 3, "above zero");
  ExpectExposureRefused(with("2", "-1/60", "100"), 3, "above zero");
  ExpectExposureRefused(with("2", "1/60", "0"), 3, "above zero");
  ExpectExposureRefused(with("1e200", "1/60", "100"), 3, "range");
  ExpectExposureRefused({"--aperture", "2", "--angle", "361", "--fps", "24", "--iso", "100"}, 3,
                        "360");
  ExpectExposureRefused({"--aperture", "2", "--angle", "180", "--fps", "0", "--iso", "100"}, 3,
                        "above zero");
  for (const char* factor : {"--transmittance", "--vignetting"}) {
    for (const char* value : {"0", "1.1", "-0.5"}) {
      Words words = with("2", "1/60", "100");
      words.insert(words.end(), {factor, value});
      ExpectExposureRefused(words, 3, "up to 1");
    }
  }
  Words sideways = with("2", "1/60", "100");
  sideways.insert(sideways.end(), {"--field-angle", "90"});
  ExpectExposureRefused(sideways, 3, "90 degrees");
  Words dark = with("2", "1/60", "100");
  dark.insert(dark.end(), {"--light", "-5lx"});
  ExpectExposureRefused(dark, 3, "less than nothing");
}

TEST(ExposureCommand, HelpShowsAnExample) {
  EXPECT_NE(Exposure({"--help"}).out.find("lightcal exposure --aperture f/2.8"), std::string::npos);
}

}  // namespace
}  // namespace lightcal
