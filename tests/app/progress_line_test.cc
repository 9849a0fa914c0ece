// SPDX-License-Identifier: Apache-2.0
#include "progress_line.h"

#include <gtest/gtest.h>

#include <vector>

#include "lightcal/core/parallel.h"

namespace lightcal::app {
namespace {

TEST(ProgressLine, SaysWhatIsLeftOnceThatIsKnown) {
  EXPECT_EQ(ProgressText("merging", 0.02, 1.0), "merging 2 %");
  EXPECT_EQ(ProgressText("merging", 0.25, 4.0), "merging 25 %, about 12 s left");
  EXPECT_EQ(ProgressText("merging", 0.1, 20.0), "merging 10 %, about 3 min left");
  EXPECT_EQ(ProgressText("merging", 0.95, 10.0), "merging 95 %") << "half a second";
  EXPECT_EQ(ProgressText("merging", 1.5, 10.0), "merging 100 %");
}

TEST(ProgressLine, IsSilentWhereNobodyLooks) {
  ProgressLine line("merging", false);
  EXPECT_FALSE(line.Watcher());
}

TEST(Progress, PiecesOfAnyThreadAddUpToTheirPart) {
  std::vector<double> told;
  const Progress whole = [&](double share) { told.push_back(share); };
  const Progress part = PartOf(whole, 0.5, 0.75);
  CountedProgress counted(part, 40);
  ParallelFor(40, [&](int) { counted.Done(); }, 4);
  ASSERT_EQ(told.size(), 40U);
  for (std::size_t i = 1; i < told.size(); ++i) EXPECT_GT(told[i], told[i - 1]);
  EXPECT_DOUBLE_EQ(told.front(), 0.5 + 0.25 / 40);
  EXPECT_DOUBLE_EQ(told.back(), 0.75);
  EXPECT_FALSE(PartOf({}, 0.0, 1.0));
}

}  // namespace
}  // namespace lightcal::app
