// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/jeti_csv.h"

#include <algorithm>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/labelled_columns.h"

namespace lightcal::devices::files {
namespace {

constexpr std::string_view kSpectrumHead = "Wavelength [nm]";
constexpr std::string_view kIrradiance = "Ee [W/(sqm*nm)]";
// x, y and X, Y, Z are printed for eight observers; the first is CIE 1931 2 degree.
constexpr HeaderLabels kJetiLabels{
    "Ev [lx] (CIE1931*", "CCT [K]", "Duv", "x", "y", "X", "Y", "Z", "Ra", "R", "", ""};

// The first table of spectra; raw counts and references follow under the same head.
struct SpectralTable {
  const Row* head = nullptr;
  SpectralRows spectral;
};

SpectralTable FindSpectralTable(const std::vector<Row>& rows) {
  SpectralTable table;
  for (const Row& row : rows) {
    if (table.head == nullptr) {
      if (CellAt(row, 0) == kSpectrumHead) table.head = &row;
      continue;
    }
    const auto wavelength = ParseNumber(CellAt(row, 0), true);
    if (!wavelength) break;
    table.spectral.wavelengths_nm.push_back(*wavelength);
    table.spectral.rows.push_back(&row);
  }
  return table;
}

std::string DeviceName(std::string_view number_row) {
  const std::size_t colon = number_row.find(':');
  const std::string_view number =
      colon == std::string_view::npos ? "" : TrimBlanks(number_row.substr(colon + 1));
  return number.empty() ? "jeti" : "jeti:" + std::string(number);
}

Result<FoundSpectrum> ReadJetiColumn(const LabelledColumns& table, const SpectralRows& spectral,
                                     std::size_t column) {
  auto spectrum = table.SpectrumOf(spectral, column, 1.0);
  if (!spectrum) return Propagate(std::move(spectrum));
  FoundSpectrum found;
  found.imported.name = table.Value("Input", column);
  found.imported.spectrum = std::move(*spectrum);
  found.imported.reported = table.Reported(kJetiLabels, column);
  found.time = IsoTime(
      std::string(table.Value("Date", column)) + " " + std::string(table.Value("Time", column)),
      DateOrder::kDayFirst);
  found.device = DeviceName(table.rows().empty() ? "" : CellAt(table.rows().front(), 0));
  found.where = std::string(table.file_name()) + ", column " +
                (found.imported.name.empty() ? std::to_string(column) : found.imported.name);
  return found;
}

}  // namespace

bool IsJetiCsv(std::string_view text) {
  return text.starts_with("Device number") &&
         (HasLineStarting(text, "Measuring mode;") || HasLineStarting(text, "Ev [lx]"));
}

Result<ImportedFile> ReadJetiCsv(std::string_view text, std::string_view name) {
  auto rows = ReadRows(text, ';');
  if (!rows) return Propagate(std::move(rows));
  const LabelledColumns table(std::move(*rows), true, name);
  const SpectralTable found_table = FindSpectralTable(table.rows());
  const auto columns = LabelledColumns::MeasuredColumns(found_table.spectral);
  if (columns.empty()) {
    return Refused("bad_spectrum", std::string(name),
                   "holds no spectra under 'Wavelength [nm]'; the file is cut short");
  }
  std::vector<FoundSpectrum> all;
  Warnings warnings;
  for (const std::size_t column : columns) {
    auto found = ReadJetiColumn(table, found_table.spectral, column);
    if (!found) return Propagate(std::move(found));
    const std::string_view unit = CellAt(*found_table.head, column);
    if (unit == kIrradiance) {
      found->imported.spectrum.quantity = SpectralQuantity::kIrradiance;
    } else {
      warnings.push_back({"relative_spectrum", found->where,
                          "its unit is '" + std::string(unit) +
                              "', not an irradiance, so only its colour is used"});
    }
    all.push_back(std::move(*found));
  }
  return ImportedFromSpectra("jeti_csv", std::move(all), std::move(warnings));
}

}  // namespace lightcal::devices::files
