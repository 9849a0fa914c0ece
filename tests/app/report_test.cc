// SPDX-License-Identifier: Apache-2.0
// lightcal report, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "lightcal/records/light_codec.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(ReportCommand, MakesThePageOfALightFile) {
  const TempDir folder;
  const std::string input =
      folder.Write("stage.json", LightFileToJson(FileOf({WarmPoint(), Sun()})).value());
  const std::string page = folder.path() + "/page.html";
  const CliResult result = RunLightcal({"report", input, "-o", page, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["files"][0], page);
  const std::string html = ReadFile(page);
  EXPECT_THAT(html, HasSubstr("<h1>stage</h1>"));
  EXPECT_THAT(html, HasSubstr("The number to type in"));
  EXPECT_THAT(html, HasSubstr("98\u202F000"));
  ASSERT_EQ(RunLightcal({"report", input, "-o", page}).exit_code, 0) << "its own file is replaced";
  EXPECT_EQ(ReadFile(page), html);
}

TEST(ReportCommand, MakesThePageOfASession) {
  const TempDir folder;
  const std::string page = folder.path() + "/page.html";
  const CliResult result =
      RunLightcal({"report", SampleData("sessions/amaran_200x_s_bare"), "-o", page});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string html = ReadFile(page);
  EXPECT_THAT(html, HasSubstr("Illuminance against distance"));
  EXPECT_THAT(html, HasSubstr("session.toml"));
}

TEST(ReportCommand, MissingOrBadInputWritesNothing) {
  const TempDir folder;
  const std::string page = folder.path() + "/page.html";
  EXPECT_EQ(RunLightcal({"report", folder.path() + "/none.json", "-o", page}).exit_code, 1);
  EXPECT_EQ(RunLightcal({"report", folder.path() + "/none", "-o", page}).exit_code, 1);
  EXPECT_EQ(RunLightcal({"report", folder.Write("bad.json", "{}"), "-o", page}).exit_code, 3);
  EXPECT_EQ(RunLightcal({"report"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(page));
}

TEST(ReportCommand, NeverReplacesWhatItDidNotWrite) {
  const TempDir folder;
  const std::string input = folder.Write("a.json", LightFileToJson(FileOf({Sun()})).value());
  const std::string page = folder.Write("page.html", "my holiday pictures");
  EXPECT_EQ(RunLightcal({"report", input, "-o", page}).exit_code, 1);
  EXPECT_EQ(ReadFile(page), "my holiday pictures");
  EXPECT_EQ(RunLightcal({"report", input, "-o", page, "--force"}).exit_code, 0);
}

// The lux of the lamps as fitted, by a formula of this test: I/(d + d0)^2 of light.json.
TEST(ReportCommand, SaysWhatEveryEngineMakesOfALampWhereTheMeterStood) {
  const TempDir folder;
  const std::string page = folder.path() + "/page.html";
  const std::string session = SampleData("sessions/amaran_200x_s_bare");
  const std::string lights = folder.path() + "/light.json";
  const auto fitted =
      nlohmann::json::parse(RunLightcal({"fit", session, "-o", lights, "--json"}).out);
  ASSERT_EQ(RunLightcal({"report", session, "-o", page}).exit_code, 0);
  const std::string html = ReadFile(page);
  const nlohmann::json& light = fitted["lights"][0];
  const double d = 3.0 + light["distance_offset_m"]["value"].get<double>();
  const double lux = light["intensity_cd"]["value"].get<double>() / (d * d);
  const std::size_t table = html.find("class=\"stack parity\"");
  ASSERT_NE(table, std::string::npos);
  const std::string rows = html.substr(table, html.find("</table>", table) - table);
  const std::regex row(
      "<th scope=\"row\">([^<]*)</th><td class=\"n\" data-label=\"gives \">([0-9.]+)");
  std::vector<std::string> engines;
  for (std::sregex_iterator found(rows.begin(), rows.end(), row), end; found != end; ++found) {
    engines.push_back((*found)[1]);
    EXPECT_NEAR(std::stod((*found)[2]), lux, 0.001 * lux) << engines.back();
  }
  EXPECT_THAT(engines, ::testing::ElementsAre("Unreal Engine", "Unity HDRP", "Godot", "Blender",
                                              "three.js, Babylon.js", "glTF", "Filament", "USD",
                                              "Mitsuba", "pbrt"));
  EXPECT_THAT(rows, HasSubstr("class=\"ran\">rendered in Cycles"));
  EXPECT_THAT(rows, HasSubstr("class=\"notran\""));
}

TEST(ReportCommand, ShowsSpectrumColourRenderingLuminanceAndDistributionWhereTheSessionHasThem) {
  const TempDir folder;
  const std::string page = folder.path() + "/page.html";
  ASSERT_EQ(RunLightcal({"report", SampleData("sessions/three_real_lights"), "-o", page}).exit_code,
            0);
  std::string html = ReadFile(page);
  EXPECT_THAT(html, HasSubstr("irradiance (mW m⁻² nm⁻¹)"));
  EXPECT_THAT(html, HasSubstr("Colour vector graphic of led_panel_5000K"));
  ASSERT_EQ(RunLightcal({"report", SampleData("sessions/lit_wall"), "-o", page}).exit_code, 0);
  html = ReadFile(page);
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(html, HasSubstr("C90 – C270"));
  EXPECT_THAT(html, HasSubstr("of the peak (1 σ)"));
  EXPECT_LT(html.size(), 1000000U);
}

TEST(ReportCommand, WritesPlotsByName) {
  const TempDir folder;
  const std::string session = SampleData("sessions/three_real_lights");
  const std::string at = folder.path() + "/";
  const CliResult made = RunLightcal({"report", session, "--plot", "distance=" + at + "d.svg",
                                      "--plot", "tm30=" + at + "t.png", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["files"],
            nlohmann::json({at + "d-cob_bare.svg", at + "d-cob_reflector.svg", at + "t.png"}));
  EXPECT_THAT(ReadFile(at + "d-cob_bare.svg"), HasSubstr("illuminance (lx)"));
  EXPECT_TRUE(ReadFile(at + "t.png").starts_with("\x89PNG"));
  ASSERT_EQ(RunLightcal({"report", session, "--plot", "distance=" + at + "one.svg", "--light",
                         "cob_bare", "-o", at + "page.html"})
                .exit_code,
            0);
  EXPECT_EQ(ReadFile(at + "one.svg"), ReadFile(at + "d-cob_bare.svg"));
  EXPECT_TRUE(fs::exists(at + "page.html"));
}

TEST(ReportCommand, APlotThatIsNoneOrThatNoLightHasWritesNothing) {
  const TempDir folder;
  const std::string input = folder.Write("a.json", LightFileToJson(FileOf({WarmPoint()})).value());
  const std::string at = folder.path() + "/";
  const CliResult unknown = RunLightcal({"report", input, "--plot", "distanec=" + at + "d.svg"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean \"distance\"?"));
  EXPECT_EQ(RunLightcal({"report", input, "--plot", "distance"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"report", input, "--plot", "distance=" + at + "d.gif"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"report", input, "--plot", "distance=" + at + "d.svg", "--light", "kex"})
                .exit_code,
            2);
  EXPECT_EQ(RunLightcal({"report", input, "--plot", "distance=" + at + "d.svg", "--plot",
                         "polar=" + at + "p.svg"})
                .exit_code,
            3);
  EXPECT_FALSE(fs::exists(at + "d.svg"));
}

}  // namespace
}  // namespace lightcal::test
