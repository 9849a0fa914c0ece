// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/uprtek_xls.h"

#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/labelled_columns.h"

namespace lightcal::devices::files {
namespace {

constexpr HeaderLabels kUprtekLabels{"LUX", "CCT", "Duv", "x", "y",  "X",
                                     "Y",   "Z",   "CRI", "R", "Rf", "Rg"};

constexpr std::string_view kFirstLabel = "Model Name";

// What stands after its first label: the instrument writes tabs; a spreadsheet that saved it again
// may have put semicolons or commas.
char DelimiterAfterFirstLabel(std::string_view text) {
  for (const char delimiter : {'\t', ';', ','}) {
    if (HasLineStarting(text, std::string(kFirstLabel) + delimiter)) return delimiter;
  }
  return '\0';
}

SpectralRows FindSpectralRows(const std::vector<Row>& rows) {
  SpectralRows spectral;
  for (const Row& row : rows) {
    std::string_view label = CellAt(row, 0);
    if (!label.ends_with("nm")) continue;
    label.remove_suffix(2);
    if (const auto wavelength = ParseNumber(label)) {
      spectral.wavelengths_nm.push_back(*wavelength);
      spectral.rows.push_back(&row);
    }
  }
  return spectral;
}

}  // namespace

bool IsUprtekXls(std::string_view text) {
  const char delimiter = DelimiterAfterFirstLabel(text);
  return delimiter != '\0' && HasLineStarting(text, std::string("LUX") + delimiter);
}

Result<ImportedFile> ReadUprtekXls(std::string_view text, std::string_view name) {
  const char delimiter = DelimiterAfterFirstLabel(text);
  auto rows = ReadRows(text, delimiter);
  if (!rows) return Propagate(std::move(rows));
  LabelledColumns table(std::move(*rows), false, name);
  const SpectralRows spectral = FindSpectralRows(table.rows());
  if (auto found = table.FindDecimals(spectral, delimiter); !found) {
    return Propagate(std::move(found));
  }
  const auto columns = LabelledColumns::MeasuredColumns(spectral);
  if (columns.empty()) {
    return Refused("bad_spectrum", std::string(name),
                   "holds no spectral samples (380nm ...); the file is cut short");
  }
  std::vector<FoundSpectrum> all;
  for (const std::size_t column : columns) {
    auto spectrum = table.SpectrumOf(spectral, column, kMilliwatt);
    if (!spectrum) return Propagate(std::move(spectrum));
    FoundSpectrum found;
    found.imported.name = table.Value("Memo", column);
    found.imported.spectrum = std::move(*spectrum);
    found.imported.spectrum.quantity = SpectralQuantity::kIrradiance;
    found.imported.reported = table.Reported(kUprtekLabels, column);
    found.imported.file_unit_W_m2_nm = kMilliwatt;
    found.time = IsoTime(table.Value("Time", column), DateOrder::kYearFirst);
    found.device = "uprtek:" + std::string(table.Value("Model Name", column)) + " " +
                   std::string(table.Value("Serial Number", column));
    found.where = name;
    all.push_back(std::move(found));
  }
  return ImportedFromSpectra("uprtek_xls", std::move(all));
}

}  // namespace lightcal::devices::files
