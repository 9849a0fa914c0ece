// SPDX-License-Identifier: Apache-2.0
// What people get wrong in a session: exit code, code word, message, and nothing written.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_cli.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kHead =
    "lightcal = 1\nname = \"t\"\n[[light]]\nname = \"key\"\nkind = \"point\"\n";

std::string Rows(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string text;
  for (const auto& [distance, lux] : rows) {
    text += "[[reading]]\nlight = \"key\"\ndistance_m = " + distance + "\nilluminance_lx = " + lux +
            "\n";
  }
  return text;
}

// Flat meters, x, y and lux, about a lamp that is said to be where it is not.
std::string Placed(const std::vector<std::array<double, 3>>& rows) {
  std::string text = "position_m = [0.776, 0.899, 1.347]\n[room]\ndark = true\n";
  for (const auto& [x, y, lux] : rows) {
    text += "[[reading]]\nlight = \"key\"\nnormal = [0, 0, 1]\nposition_m = [" + std::to_string(x) +
            ", " + std::to_string(y) + ", 0.0]\nilluminance_lx = " + std::to_string(lux) + "\n";
  }
  return text;
}

struct Case {
  const char* name;
  std::string toml;
  int exit_code;
  const char* code;
  const char* says;  // in the message: what or where
};

class BadSession : public ::testing::TestWithParam<Case> {};

TEST_P(BadSession, IsRefusedWithAReasonAndNothingIsWritten) {
  const TempDir session;
  session.Write("session.toml", GetParam().toml);
  const CliResult result = RunLightcal({"run", session.path(), "--json"});
  EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(document["error"]["code"], GetParam().code) << document.dump(2);
  const std::string all = document["error"].dump();
  EXPECT_NE(all.find(GetParam().says), std::string::npos) << all;
  EXPECT_FALSE(fs::exists(session.path() + "/out"));
}

INSTANTIATE_TEST_SUITE_P(
    Sessions, BadSession,
    ::testing::Values(
        Case{"Empty", "", 3, "bad_session", "lightcal"},
        Case{"NotToml", "lightcal = = 1", 3, "bad_session", "session.toml"},
        Case{"NoLight", "lightcal = 1\nname = \"t\"\n", 3, "no_light", "[[light]]"},
        Case{"NoReadings", kHead, 3, "no_readings", "key"},
        // An offset of 1.06 m below the lamp, and 11 cd of 300, were learned of it.
        Case{"TwoReadingsOfALampElsewhere", kHead + Placed({{0.5, 0.5, 75.9}, {1.0, 1.0, 114.5}}),
             3, "model_misfit", "1.1 m before the point that distances are counted from"},
        Case{"ThreeReadingsOfALampElsewhere",
             kHead + Placed({{0.0, 0.0, 39.6}, {1.0, 0.0, 49.61}, {0.0, 1.0, 78.79}}), 3,
             "model_misfit", "do the lamp and the meters stand where"},
        Case{"NotANumber", kHead + Rows({{"nan", "100.0"}}), 3, "bad_session", "distance_m"},
        Case{"InfiniteLux", kHead + Rows({{"1.0", "inf"}}), 3, "bad_session", "illuminance_lx"},
        Case{"NegativeDistance", kHead + Rows({{"-1.0", "100.0"}}), 3, "bad_session", "distance_m"},
        Case{"ZeroDistance", kHead + Rows({{"0.0", "100.0"}}), 3, "bad_session", "distance_m"},
        Case{"CentimetresAmongMetres",
             kHead +
                 Rows({{"1.0", "1000.0"}, {"2.0", "250.0"}, {"300.0", "111.0"}, {"400.0", "62.5"}}),
             3, "units_ambiguous", "cm"},
        Case{"DuplicateLight", kHead + "[[light]]\nname = \"key\"\nkind = \"point\"\n", 3,
             "duplicate_name", "key"},
        Case{"UnknownKey", kHead + "[[reading]]\nlight = \"key\"\ndistnace_m = 1.0\n", 3,
             "unknown_key", "distance_m"},
        Case{"UnknownLight",
             kHead + "[[reading]]\nlight = \"kye\"\ndistance_m = 1.0\n"
                     "illuminance_lx = 10.0\n",
             3, "unknown_light", "key"},
        Case{"MissingSpectrum",
             kHead + "[[reading]]\nlight = \"key\"\ndistance_m = 1.0\n"
                     "illuminance_lx = 10.0\nspectrum = \"absent.xls\"\n",
             1, "not_found", "absent.xls"}),
    [](const auto& session) { return std::string(session.param.name); });

TEST(BadInput, AMissingSessionIsNotFound) {
  const CliResult result = RunLightcal({"run", "no/such/session"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no/such/session"), std::string::npos) << result.err;
}

TEST(BadInput, BadRowsOfTheJournalAreRejectedAndTheRestStillAnswers) {
  const TempDir session;
  session.Write("session.toml", kHead);
  session.Write("readings.jsonl",
                "{\"light\":\"key\",\"distance_m\":1.0,\"illuminance_lx\":100.0}\n"
                "{\"light\":\"key\",\"distance_m\":-2.0,\"illuminance_lx\":25.0}\n"
                "not json at all\n"
                "{\"light\":\"key\",\"distance_m\":2.0,\"illuminance_lx\":25.0}\n"
                "{\"light\":\"key\",\"distance_m\":3.0,\"illumin");
  const CliResult result = RunLightcal({"run", session.path(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json document = json::parse(result.out);
  std::vector<std::string> codes;
  for (const json& warning : document["warnings"]) codes.push_back(warning["code"]);
  EXPECT_EQ(std::ranges::count(codes, "bad_reading"), 2);
  EXPECT_EQ(std::ranges::count(codes, "torn_journal"), 1);
  EXPECT_EQ(document["lights"][0]["fit"]["used"], 2);
  EXPECT_NE(result.err.find("readings.jsonl:3"), std::string::npos) << result.err;
}

TEST(BadInput, AJournalWithNoValidRowIsRefused) {
  const TempDir session;
  session.Write("session.toml", kHead);
  session.Write("readings.jsonl", "{\"light\":\"key\",\"distance_m\":0,\"illuminance_lx\":1}\n");
  const CliResult result = RunLightcal({"run", session.path()});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_FALSE(fs::exists(session.path() + "/out"));
}

TEST(BadInput, StrictTurnsAWarningIntoARefusalBeforeAnythingIsWritten) {
  const TempDir session;
  session.Write("session.toml", kHead + Rows({{"1.0", "100.0"}, {"2.0", "25.0"}}));
  session.Write("readings.jsonl", "garbage\n");
  EXPECT_EQ(RunLightcal({"run", session.path(), "--strict"}).exit_code, 3);
  EXPECT_FALSE(fs::exists(session.path() + "/out"));
  EXPECT_EQ(RunLightcal({"run", session.path()}).exit_code, 0);
}

TEST(BadInput, AnUnwritableOutputFailsAndLeavesNothing) {
  const TempDir session;
  session.Write("session.toml", kHead + Rows({{"1.0", "100.0"}, {"2.0", "25.0"}}));
  const std::string blocked = session.Write("a_file", "not a folder");
  const CliResult result = RunLightcal({"run", session.path(), "-o", blocked + "/below"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("a_file"), std::string::npos) << result.err;
  EXPECT_EQ(ReadFile(blocked), "not a folder");
}

TEST(BadInput, AFullDiskLeavesTheOldFilesWhole) {
  const TempDir session;
  session.Write("session.toml", kHead + Rows({{"1.0", "100.0"}, {"2.0", "25.0"}}));
  ASSERT_EQ(RunLightcal({"run", session.path()}).exit_code, 0);
  const std::string before = ReadFile(session.path() + "/out/light.json");
  // RLIMIT_FSIZE stands in for the disk; the shell sets it and ignores the signal it sends.
  const CliResult result =
      RunProgram({"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" run \"$1\"",
                  LIGHTCAL_BINARY, session.path()});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(ReadFile(session.path() + "/out/light.json"), before);
  for (const auto& entry : fs::directory_iterator(session.path() + "/out")) {
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
  }
}

}  // namespace
}  // namespace lightcal::test
