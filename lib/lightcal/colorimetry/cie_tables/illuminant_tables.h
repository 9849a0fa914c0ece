// SPDX-License-Identifier: Apache-2.0
// The CIE's tabulated illuminants, (c) CIE, CC BY-SA 4.0: see LICENSE here.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace lightcal {

// Relative spectral power in steps of 5 nm from first_nm. The FL tables are band averages, so the
// plain 5 nm sum is their meaning.  Source: CIE 15:2018, tables 6, 10, 11, 12.
inline constexpr int kIlluminantStepNm = 5;
struct IlluminantTable {
  std::string_view name;
  int first_nm;
  std::span<const double> values;
};
[[nodiscard]] std::span<const IlluminantTable> IlluminantTables();

}  // namespace lightcal
