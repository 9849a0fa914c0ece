// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/student.h"

#include <gtest/gtest.h>

#include <array>

namespace lightcal {
namespace {

// Source: Fisher & Yates, Statistical Tables, table III: two-sided 5 %.
TEST(StudentOverNormal, IsTheTables) {
  struct Row {
    double freedom, t;
  };
  for (const Row row : std::array<Row, 8>{{{1, 12.706},
                                           {2, 4.303},
                                           {3, 3.182},
                                           {4, 2.776},
                                           {5, 2.571},
                                           {10, 2.228},
                                           {30, 2.042},
                                           {120, 1.980}}}) {
    EXPECT_NEAR(StudentOverNormal(row.freedom) * kZ95 / row.t, 1.0, 0.005) << row.freedom;
  }
}

}  // namespace
}  // namespace lightcal
