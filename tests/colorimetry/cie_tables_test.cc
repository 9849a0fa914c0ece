// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "lightcal/colorimetry/cie_tables/tables.h"

namespace lightcal {
namespace {

// The checksums that two independent copies of the CIE table agree on to 5e-13.
TEST(CieTables, ColumnSumsOfTheColourMatchingFunctionsAreCies) {
  CmfRow sum{};
  for (const CmfRow& row : Cie1931Cmf()) {
    sum = {sum.x_bar + row.x_bar, sum.y_bar + row.y_bar, sum.z_bar + row.z_bar};
  }
  EXPECT_NEAR(sum.x_bar, 106.86546949, 5e-9);
  EXPECT_NEAR(sum.y_bar, 106.8569171, 5e-8);
  EXPECT_NEAR(sum.z_bar, 106.89225128, 5e-9);
}

TEST(CieTables, DaylightComponentsAreCentredAt560Nanometres) {
  const DaylightComponentRow& centre = CieDaylightComponents()[(560 - 300) / 5];
  EXPECT_EQ(centre.s0, 100.0);
  EXPECT_EQ(centre.s1, 0.0);
  EXPECT_EQ(centre.s2, 0.0);
}

// The CIE tabulates every 10 nm; the rows between are the means of their neighbours.
TEST(CieTables, OddDaylightRowsAreLinearBetweenTheirNeighbours) {
  for (std::size_t i = 1; i + 1 < CieDaylightComponents().size(); i += 2) {
    const auto& a = CieDaylightComponents()[i - 1];
    const auto& b = CieDaylightComponents()[i];
    const auto& c = CieDaylightComponents()[i + 1];
    EXPECT_NEAR(b.s0, (a.s0 + c.s0) / 2, 1e-12) << i;
    EXPECT_NEAR(b.s1, (a.s1 + c.s1) / 2, 1e-12) << i;
    EXPECT_NEAR(b.s2, (a.s2 + c.s2) / 2, 1e-12) << i;
  }
}

}  // namespace
}  // namespace lightcal
