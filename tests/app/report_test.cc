// SPDX-License-Identifier: Apache-2.0
// lightcal report, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace lightcal::test
