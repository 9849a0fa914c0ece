// SPDX-License-Identifier: Apache-2.0
// Which rows of the list of the seed's errors have a test: all that are a wrong formula or number
// (E), an ambiguous convention (A) or a wrong concept (C). The rest are slips of the pen (T).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string_view>

namespace lightcal {
namespace {

const std::set<int> kErrors = {1,  2,  3,  5,  6,  7,  11, 14, 17, 18,
                               19, 25, 26, 27, 28, 30, 31, 34, 39};
const std::set<int> kAmbiguities = {4, 9, 15, 21, 29, 32, 33, 37, 41, 44, 49};
const std::set<int> kConcepts = {10, 12, 13, 20, 22, 23, 35, 36, 38, 43, 48};

// 7 from "Row07SpotAttenuation...", 0 from any other name.
int RowNumber(std::string_view test) {
  const auto digit = [&](std::size_t i) {
    return std::isdigit(static_cast<unsigned char>(test[i]));
  };
  if (test.size() < 6 || !test.starts_with("Row") || !digit(3) || !digit(4) || digit(5)) return 0;
  return (test[3] - '0') * 10 + (test[4] - '0');
}

TEST(SeedErrorSet, EveryErrorAmbiguityAndWrongConceptHasItsTest) {
  std::set<int> wanted = kErrors;
  wanted.insert(kAmbiguities.begin(), kAmbiguities.end());
  wanted.insert(kConcepts.begin(), kConcepts.end());
  EXPECT_EQ(wanted.size(), 41U);
  std::set<int> tested;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    if (std::string_view(suite.name()) != "SeedErrors") continue;
    for (int t = 0; t < suite.total_test_count(); ++t) {
      tested.insert(RowNumber(suite.GetTestInfo(t)->name()));
    }
  }
  EXPECT_THAT(tested, testing::ContainerEq(wanted));
}

}  // namespace
}  // namespace lightcal
