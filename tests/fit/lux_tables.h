// SPDX-License-Identifier: Apache-2.0
// The nineteen published lux tables of sample_data/lux_tables, as sessions.
#pragma once

#include <string>
#include <vector>

#include "lightcal/records/session.h"

namespace lightcal::test {

struct LuxTable {
  std::string fixture;
  std::string accessory;
  double nominal_cct_K = 0.0;
  std::vector<double> distances_m;
  std::vector<double> illuminances_lx;
};

[[nodiscard]] std::vector<LuxTable> LoadLuxTables();

// One point light "lamp" read by `meter` at the first `count` distances of the table (all by
// default).
[[nodiscard]] Session SessionOf(const LuxTable& table, const std::string& meter,
                                std::size_t count = 1000);

}  // namespace lightcal::test
