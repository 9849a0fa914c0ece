// SPDX-License-Identifier: Apache-2.0
// The numbers come from the .csv files beside this one when the build is configured; they are (c)
// CIE, CC BY-SA 4.0: see LICENSE here.
#include <cstddef>

#include "lightcal/colorimetry/cie_tables/alpha_opic.h"
#include "lightcal/colorimetry/cie_tables/illuminant_tables.h"
#include "lightcal/colorimetry/cie_tables/samples.h"
#include "lightcal/colorimetry/cie_tables/tables.h"

namespace lightcal {
namespace {

constexpr std::array<CmfRow, kCmfCount> kCie1931Cmf = {{
#include "cie_1931_2deg_cmf_1nm.inc"
}};
constexpr std::array<CmfRow, kCmfCount> kCie1964Cmf = {{
#include "cie_1964_10deg_cmf_1nm.inc"
}};
constexpr std::array<DaylightComponentRow, kDaylightCount> kDaylightComponents = {{
#include "cie_daylight_components_5nm.inc"
}};
constexpr double kMelanopicRows[][1] = {
#include "cie_s026_melanopic_1nm.inc"
};
constexpr double kFourteenCriSamples[][kCriSampleCount - 1] = {
#include "cie_cri_14_test_samples_5nm.inc"
};
constexpr double kFifteenthCriSample[][1] = {
#include "jis_z_8726_r15_reflectance.inc"
};
constexpr double kCfiRows[][kCfiSampleCount] = {
#include "cie_cfi_99_test_samples_5nm.inc"
};
constexpr std::string_view kLampNames[] = {
#include "cie_lamp_illuminants_5nm.names.inc"
};
constexpr double kLamps[][std::size(kLampNames)] = {
#include "cie_lamp_illuminants_5nm.inc"
};
constexpr std::string_view kDaylightNames[] = {
#include "cie_daylight_illuminants_5nm.names.inc"
};
constexpr double kDaylights[][std::size(kDaylightNames)] = {
#include "cie_daylight_illuminants_5nm.inc"
};
constexpr int kFirstLampNm = 380, kFirstDaylightNm = 300;

// Column after column.
template <std::size_t kRows, std::size_t kColumns>
constexpr std::array<std::array<double, kRows>, kColumns> ColumnsOf(
    const double (&rows)[kRows][kColumns]) {
  std::array<std::array<double, kRows>, kColumns> columns{};
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t c = 0; c < kColumns; ++c) columns[c][row] = rows[row][c];
  }
  return columns;
}

// Tables of the same rows, side by side.
template <std::size_t kRows, std::size_t... kColumns>
constexpr auto RowsOf(const double (&... tables)[kRows][kColumns]) {
  std::array<std::array<double, (kColumns + ...)>, kRows> out{};
  for (std::size_t row = 0; row < kRows; ++row) {
    std::size_t at = 0;
    const auto append = [&](const auto& values) {
      for (const double value : values) out[row][at++] = value;
    };
    (append(tables[row]), ...);
  }
  return out;
}

constexpr auto kMelanopic = ColumnsOf(kMelanopicRows);
constexpr auto kCriSamples = RowsOf(kFourteenCriSamples, kFifteenthCriSample);
constexpr auto kCfiSamples = RowsOf(kCfiRows);
constexpr auto kLampColumns = ColumnsOf(kLamps);
constexpr auto kDaylightColumns = ColumnsOf(kDaylights);

constexpr auto kIlluminants = [] {
  std::array<IlluminantTable, kLampColumns.size() + kDaylightColumns.size()> tables{};
  std::size_t at = 0;
  for (std::size_t i = 0; i < kLampColumns.size(); ++i) {
    tables[at++] = {kLampNames[i], kFirstLampNm, kLampColumns[i]};
  }
  for (std::size_t i = 0; i < kDaylightColumns.size(); ++i) {
    tables[at++] = {kDaylightNames[i], kFirstDaylightNm, kDaylightColumns[i]};
  }
  return tables;
}();

}  // namespace

const std::array<CmfRow, kCmfCount>& Cie1931Cmf() { return kCie1931Cmf; }
const std::array<CmfRow, kCmfCount>& Cie1964Cmf() { return kCie1964Cmf; }
const std::array<DaylightComponentRow, kDaylightCount>& CieDaylightComponents() {
  return kDaylightComponents;
}
const std::array<double, kMelanopicCount>& MelanopicActionSpectrum() { return kMelanopic[0]; }
const std::array<CriSampleRow, kCriRowCount>& CriSamples() { return kCriSamples; }
const std::array<CfiSampleRow, kCfiRowCount>& CfiSamples() { return kCfiSamples; }
std::span<const IlluminantTable> IlluminantTables() { return kIlluminants; }

}  // namespace lightcal
