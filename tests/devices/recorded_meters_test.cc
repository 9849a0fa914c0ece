// SPDX-License-Identifier: Apache-2.0
// Every tape the manifest lists is played by the built binary: a new meter's tape is a new test.
// Beside X.tape may stand X.expected.json: keys of the answer that must come out (numbers to 1e-6),
// or {"error":{"code":...}} for a dialogue that fails.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "run_cli.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> TapesOfTheManifest() {
  std::vector<std::string> tapes;
  std::ifstream manifest(SampleData("MANIFEST.sha256"));
  std::string sum;
  std::string name;
  while (manifest >> sum >> name) {
    if (name.ends_with(".tape")) tapes.push_back(name);
  }
  return tapes;
}

json ExpectedOf(const std::string& tape) {
  const std::string path = SampleData(tape.substr(0, tape.size() - 5) + ".expected.json");
  return fs::exists(path) ? json::parse(ReadFile(path)) : json::object();
}

void ExpectSame(const json& found, const json& expected, const std::string& key) {
  if (expected.is_number()) {
    ASSERT_TRUE(found.is_number()) << key;
    const double value = expected;
    EXPECT_NEAR(double(found), value, 1e-6 * std::max(std::abs(value), 1e-3)) << key;
  } else if (expected.is_structured()) {
    ASSERT_EQ(found.size(), expected.size()) << key;
    for (const auto& [inner, value] : expected.items()) {
      ExpectSame(expected.is_object() ? found.value(inner, json()) : found.at(std::stoul(inner)),
                 value, key + "." + inner);
    }
  } else {
    EXPECT_EQ(found, expected) << key;
  }
}

// What was said, without when.
std::vector<json> Exchanges(const std::string& path) {
  std::vector<json> exchanges;
  std::istringstream lines(ReadFile(path));
  std::string line;
  std::getline(lines, line);  // the header
  while (std::getline(lines, line)) {
    exchanges.push_back(json::parse(line));
    exchanges.back().erase("t_ms");
  }
  return exchanges;
}

class RecordedMeters : public testing::TestWithParam<std::string> {};

TEST_P(RecordedMeters, ReadAsTheyAreKnownTo) {
  const json expected = ExpectedOf(GetParam());
  const CliResult result =
      RunLightcal({"read", "--once", "--json", "--replay", SampleData(GetParam())});
  const json found = json::parse(result.out);
  EXPECT_EQ(result.exit_code == 0, !expected.contains("error")) << result.err;
  for (const auto& [key, value] : expected.items()) {
    if (key == "error") {
      EXPECT_EQ(found["error"]["code"], value["code"]);
    } else {
      ExpectSame(found.value(key, json()), value, key);
    }
  }
}

TEST_P(RecordedMeters, PlayToTheirEndAndRecordAgainAsTheSameDialogue) {
  const TempDir dir;
  const std::string session =
      dir.Write("session.toml", "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n");
  const std::string again = dir.path() + "/again.tape";
  const std::string tape = SampleData(GetParam());
  const CliResult result = RunLightcal({"read", "-s", session, "--light", "key", "--distance", "1m",
                                        "--json", "--replay", tape, "--record", again});
  EXPECT_THAT(result.out, Not(HasSubstr("tape_not_finished"))) << result.err;
  EXPECT_EQ(Exchanges(again), Exchanges(tape));
}

INSTANTIATE_TEST_SUITE_P(Manifest, RecordedMeters, testing::ValuesIn(TapesOfTheManifest()),
                         [](const auto& tape) {
                           std::string name = fs::path(tape.param).stem().string();
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

TEST(RecordedMetersList, TheManifestListsTapes) { EXPECT_FALSE(TapesOfTheManifest().empty()); }

}  // namespace
}  // namespace lightcal::test
