// SPDX-License-Identifier: Apache-2.0
// lightcal reference, driven as a shell would.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

test::CliResult Reference(Words words) {
  words.insert(words.begin(), "reference");
  return test::RunLightcal(words);
}

json Values(const Words& words) { return test::LightcalJson("reference", words)["values"]; }

TEST(ReferenceCommand, ListsAtLeastFortyValuesOfFourQuantitiesWithTheirSources) {
  const json values = Values({});
  EXPECT_GE(values.size(), 40U);
  std::set<std::string> quantities;
  for (const json& row : values) {
    quantities.insert(row["quantity"]);
    EXPECT_FALSE(row["source"].get<std::string>().empty()) << row;
    EXPECT_LE(row["low"].get<double>(), row["high"].get<double>()) << row;
    EXPECT_FALSE(row["unit"].get<std::string>().empty()) << row;
  }
  EXPECT_EQ(quantities, (std::set<std::string>{"luminous flux", "illuminance", "luminance",
                                               "luminous efficacy"}));
}

TEST(ReferenceCommand, FlagsTheSeedsFullMoonAndBulb) {
  const json moon = Values({"full", "moon"});
  ASSERT_EQ(moon.size(), 1U);
  EXPECT_EQ(moon[0]["seed_doubtful"], true);
  EXPECT_EQ(moon[0]["seed_value"], 0.5);
  EXPECT_LT(moon[0]["high"], 0.5);
  const json bulb = Values({"incandescent bulb 60 W", "efficacy"});
  ASSERT_EQ(bulb.size(), 1U);
  EXPECT_EQ(bulb[0]["seed_value"], 10.0);
  EXPECT_GT(bulb[0]["low"], 10.0);
  // Of the moon, the moon alone; what another text printed is no one's question.
  const test::CliResult plain = Reference({"moon"});
  EXPECT_EQ(plain.out.find("sun"), std::string::npos) << plain.out;
  EXPECT_EQ(plain.out.find("seed"), std::string::npos) << plain.out;
  const test::CliResult table = Reference({"moon", "--verbose"});
  EXPECT_NE(table.out.find("Printed otherwise"), std::string::npos) << table.out;
  EXPECT_EQ(Reference({"office"}).out.find("Doubtful"), std::string::npos);
}

TEST(ReferenceCommand, AWordFiltersWithoutRegardToCase) {
  EXPECT_EQ(Values({"MOON"}), Values({"moon"}));
  for (const auto& [word, quantity] : {std::pair{"lux", "illuminance"},
                                       {"nits", "luminance"},
                                       {"luminance", "luminance"},
                                       {"lumens", "luminous flux"},
                                       {"efficacy", "luminous efficacy"}}) {
    const json values = Values({word});
    EXPECT_GE(values.size(), 8U) << word;
    EXPECT_TRUE(std::ranges::all_of(values, [&](const json& row) {
      return row["quantity"] == quantity;
    })) << word;
  }
}

TEST(ReferenceCommand, PrintsATableWithUnitsAndSources) {
  const test::CliResult run = Reference({"office"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("500"), std::string::npos);
  EXPECT_NE(run.out.find("lx"), std::string::npos);
  EXPECT_NE(run.out.find("EN 12464-1:2011"), std::string::npos) << run.out;
}

TEST(ReferenceCommand, AnUnknownWordIsAnsweredWithWordsThatWork) {
  const test::CliResult run = Reference({"zebra"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("moon"), std::string::npos) << run.err;
}

TEST(ReferenceCommand, HelpShowsAnExample) {
  EXPECT_NE(Reference({"--help"}).out.find("lightcal reference full moon"), std::string::npos);
}

}  // namespace
}  // namespace lightcal
