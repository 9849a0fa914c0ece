// SPDX-License-Identifier: Apache-2.0
// Every error of rows.txt has a test of its name, and every test stands there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <string_view>

namespace lightcal {
namespace {

TEST(SeedErrorSet, EveryErrorHasItsTest) {
  std::set<std::string> listed;
  std::ifstream lines(LIGHTCAL_SOURCE_DIR "/tests/seed_errors/rows.txt");
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('#')) listed.insert(line.substr(0, line.find(' ')));
  }
  EXPECT_EQ(listed.size(), 41U);
  std::set<std::string> tested;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    if (std::string_view(suite.name()) != "SeedErrors") continue;
    for (int t = 0; t < suite.total_test_count(); ++t) tested.insert(suite.GetTestInfo(t)->name());
  }
  EXPECT_THAT(tested, testing::ContainerEq(listed));
}

}  // namespace
}  // namespace lightcal
