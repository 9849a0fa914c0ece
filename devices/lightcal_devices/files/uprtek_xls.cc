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
  return HasLineStarting(text, "Model Name\t") && HasLineStarting(text, "LUX\t");
}

Result<ImportedFile> ReadUprtekXls(std::string_view text, std::string_view name) {
  auto rows = ReadRows(text, '\t');
  if (!rows) return Propagate(std::move(rows));
  const LabelledColumns table(std::move(*rows), false, name);
  const SpectralRows spectral = FindSpectralRows(table.rows());
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
