// SPDX-License-Identifier: Apache-2.0
// Every row of the table (rows.txt: 82 inputs, numerically hard) has a test of its name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "hard_case.h"

namespace lightcal::test::hard {
namespace {

std::set<std::string> RowsOfTable() {
  std::set<std::string> rows;
  std::istringstream lines(
      ReadFile(std::string(LIGHTCAL_SOURCE_DIR) + "/tests/hard_cases/rows.txt"));
  for (std::string line; std::getline(lines, line);) rows.insert(line.substr(0, 3));
  return rows;
}

TEST(HardCaseSet, EveryRowHasItsTest) {
  const std::set<std::string> rows = RowsOfTable();
  EXPECT_EQ(rows.size(), 82U);
  std::set<std::string> tested;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    const std::string_view name = suite.name();
    if (name.size() != 9 || !name.starts_with("HardCase")) continue;
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const std::string row = std::string(suite.GetTestInfo(t)->name()).substr(0, 3);
      EXPECT_EQ(row.front(), name.back()) << row << " stands in " << name;
      tested.insert(row);
    }
  }
  EXPECT_THAT(tested, testing::ContainerEq(rows));
}

TEST(HardCaseSet, WordsThatAreNoNumbersAreFound) {
  for (const char* text : {"nan", "[1, NaN]", "-inf", "x = Infinity;", "inf\n"}) {
    EXPECT_TRUE(HoldsNonFinite(text)) << text;
  }
  for (const char* text : {"", "finance", "beyond_infinity", "info", "nano", "1.0"}) {
    EXPECT_FALSE(HoldsNonFinite(text)) << text;
  }
}

}  // namespace
}  // namespace lightcal::test::hard
