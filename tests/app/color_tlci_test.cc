// SPDX-License-Identifier: Apache-2.0
// TLCI through ArgyllCMS's specplot, the installed one and stand-ins that misbehave.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using test::RunLightcal;

// A folder with a specplot of ours.
class StandIn {
 public:
  explicit StandIn(const std::string& script) {
    const std::string program = folder_.Write("specplot", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] test::CliResult Run() const {
    return RunLightcal({"color", "--spectrum", "illuminant:FL4", "--tlci", "--json"}, "",
                       {"PATH=" + folder_.path() + ":/usr/bin:/bin"});
  }
  [[nodiscard]] const std::string& path() const { return folder_.path(); }

 private:
  test::TempDir folder_;
};

std::string CodeOf(const test::CliResult& run) {
  return json::parse(run.out)["error"]["code"].get<std::string>();
}

TEST(ColorTlci, OfCieIlluminantsIsArgylls) {
  std::ifstream vectors(test::SampleData("vectors/illuminants.csv"));
  std::string line, cell;
  std::getline(vectors, line);
  int column = 0;
  std::istringstream header(line);
  while (std::getline(header, cell, ',') && cell != "TLCI_argyll") ++column;
  int lights = 0;
  while (std::getline(vectors, line)) {
    std::istringstream row(line);
    std::string name;
    std::getline(row, name, ',');
    for (int i = 0; i < column; ++i) std::getline(row, cell, ',');
    const json tlci =
        test::LightcalJson("color", {"--spectrum", "illuminant:" + name, "--tlci"})["tlci"];
    EXPECT_NEAR(tlci["Qa"].get<double>(), std::stod(cell), 0.11) << name;
    EXPECT_TRUE(tlci["by"].get<std::string>().starts_with("ArgyllCMS ")) << name;
    ++lights;
  }
  EXPECT_EQ(lights, 35);
}

// Four measured film lights; the reference was linear to 1 nm, which moves the index by 0.1.
TEST(ColorTlci, OfFilmLightsIsArgylls) {
  const std::vector<double> published = {72.0, 95.8, 86.6, 89.7};  // vectors/ampas_sources.csv
  for (std::size_t light = 0; light < published.size(); ++light) {
    std::ifstream source(test::SampleData("ampas_sources/test_sources_2nm.csv"));
    std::string line, cell;
    std::getline(source, line);
    std::string table = "wavelength_nm,relative\n";
    while (std::getline(source, line)) {
      std::istringstream row(line);
      std::getline(row, cell, ',');
      table += cell + ",";
      for (std::size_t i = 0; i <= light; ++i) std::getline(row, cell, ',');
      table += cell + "\n";
    }
    const test::TempDir dir;
    const json answer = test::LightcalJson(
        "color", {"--spectrum", dir.Write("film.csv", table), "--tlci", "--sampling", "band"});
    EXPECT_NEAR(answer["tlci"]["Qa"].get<double>(), published[light], 0.21) << light;
  }
}

TEST(ColorTlci, OfUnequalStepsIsThatOfOneNanometre) {
  const json tlci = test::LightcalJson(
      "color", {"--spectrum", test::SampleData("spectra/colour_science/Fluorescent.spdx"),
                "--tlci"})["tlci"];
  EXPECT_GT(tlci["Qa"].get<double>(), 0.0);
  EXPECT_LT(tlci["Qa"].get<double>(), 100.0);
}

TEST(ColorTlci, OfStepsBelowOneNanometreIsThatOfOneNanometre) {
  const auto qa = [](int samples_per_nm) {
    std::string table = "wavelength_nm,relative\n";
    for (int i = 0; i <= 400 * samples_per_nm; ++i) {
      const double nm = 380.0 + static_cast<double>(i) / samples_per_nm;
      table += std::to_string(nm) + "," + std::to_string(nm - 300.0) + "\n";
    }
    const test::TempDir dir;
    const std::string file = dir.Write("ramp.csv", table);
    return test::LightcalJson("color", {"--spectrum", file, "--tlci"})["tlci"]["Qa"].get<double>();
  };
  EXPECT_NEAR(qa(4), qa(1), 0.11);
}

TEST(ColorTlci, IsAskedForOfSpectraOnly) {
  EXPECT_EQ(RunLightcal({"color", "--cct", "3200", "--tlci"}).exit_code, 2);
  EXPECT_FALSE(test::LightcalJson("color", {"--spectrum", "illuminant:A"}).contains("tlci"));
}

TEST(ColorTlci, WithoutArgyllSaysWhatToInstall) {
  const test::TempDir empty;
  const auto run = RunLightcal({"color", "--spectrum", "illuminant:FL4", "--tlci"}, "",
                               {"PATH=" + empty.path()});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("apt install argyll"), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST(ColorTlci, AnAnswerWithoutAnIndexIsAFailure) {
  for (const char* script : {"echo garbage", "exit 3", "echo 'TLCI = lots'", "echo 'TLCI = nan'",
                             "echo 'TLCI = 101'", "while :; do echo aaaaaaaaaaaaaaaaaaaa; done"}) {
    const auto run = StandIn(script).Run();
    EXPECT_EQ(run.exit_code, 1) << script;
    EXPECT_EQ(CodeOf(run), "program_failed") << script;
  }
}

TEST(ColorTlci, AnIndexOfMinusOneIsNone) {
  const auto run = StandIn("echo 'TLCI = -1.0'").Run();
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(CodeOf(run), "no_tlci");
}

TEST(ColorTlci, AnIndexTooFarFromWhiteIsMarked) {
  const auto run = StandIn("echo 'TLCI = 12.5 (Invalid)'").Run();
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json tlci = json::parse(run.out)["tlci"];
  EXPECT_EQ(tlci["Qa"], 12.5);
  EXPECT_TRUE(tlci["far_from_white"].get<bool>());
  EXPECT_EQ(tlci["by"], "ArgyllCMS");  // no spec2cie beside it to tell the version
}

TEST(ColorTlci, AProgramThatHangsIsStoppedWithItsChildren) {
  const StandIn hanging("(sleep 12; touch \"$(dirname \"$0\")/late\") & sleep 60");
  const auto start = std::chrono::steady_clock::now();
  const auto run = hanging.Run();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(CodeOf(run), "program_failed");
  EXPECT_NE(run.out.find("ran longer than 5000 ms"), std::string::npos) << run.out;
}

TEST(ColorTlci, ItsInputIsAFileThatIsGoneAfterwards) {
  const StandIn nosy(
      "cp \"$2\" \"$(dirname \"$0\")/input\"; echo \"$2\" > \"$(dirname \"$0\")/name\"; "
      "echo 'TLCI = 50.0'");
  EXPECT_EQ(nosy.Run().exit_code, 0);
  const std::string input = test::ReadFile(nosy.path() + "/input");
  EXPECT_TRUE(input.starts_with("SPECT"));
  EXPECT_NE(input.find("SPECTRAL_BANDS \"81\""), std::string::npos);
  EXPECT_NE(input.find(" 100.000000 "), std::string::npos);
  std::string name = test::ReadFile(nosy.path() + "/name");
  name.pop_back();
  EXPECT_TRUE(name.ends_with(".sp"));
  EXPECT_FALSE(std::filesystem::exists(name));
}

}  // namespace
}  // namespace lightcal
