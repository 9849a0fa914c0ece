// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/sekonic_csv.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/labelled_columns.h"

namespace lightcal::devices::files {
namespace {

constexpr std::string_view kSample = "Spectral Data ";
constexpr std::string_view kSampleEnd = "[nm]";
// The Duv label begins with a triangle whose encoding depends on the computer it was saved on.
constexpr HeaderLabels kSekonicLabels{"Illuminance [lx]",
                                      "Tcp [K]",
                                      "*uv",
                                      "CIE1931 x",
                                      "CIE1931 y",
                                      "Tristimulus Value X",
                                      "Tristimulus Value Y",
                                      "Tristimulus Value Z",
                                      "CRI Ra",
                                      "CRI R",
                                      "TM-30 Rf",
                                      "TM-30 Rg"};

std::optional<double> SampleWavelength(std::string_view label) {
  if (!label.starts_with(kSample) || !label.ends_with(kSampleEnd)) return std::nullopt;
  label.remove_prefix(kSample.size());
  label.remove_suffix(kSampleEnd.size());
  return ParseNumber(label);
}

// Semicolons or tabs where the computer's decimals are commas.
char DelimiterOfSamples(std::string_view text) {
  const std::size_t sample = text.find(kSample);
  if (sample == std::string_view::npos) return ',';
  const std::string_view line = text.substr(sample);
  return DelimiterOf(line.substr(0, line.find('\n')));
}

// The 5 nm and the 1 nm block begin at the same wavelength; the one with more samples is taken.
SpectralRows FinestBlock(const std::vector<Row>& rows) {
  SpectralRows finest;
  SpectralRows block;
  const auto close_block = [&] {
    if (block.rows.size() > finest.rows.size()) finest = block;
    block = {};
  };
  for (const Row& row : rows) {
    const auto wavelength = SampleWavelength(CellAt(row, 0));
    if (!wavelength) continue;
    if (!block.rows.empty() && *wavelength == block.wavelengths_nm.front()) close_block();
    block.wavelengths_nm.push_back(*wavelength);
    block.rows.push_back(&row);
  }
  close_block();
  return finest;
}

Result<FoundSpectrum> ReadSekonicColumn(const LabelledColumns& table, const SpectralRows& spectral,
                                        std::size_t column) {
  auto spectrum = table.SpectrumOf(spectral, column, 1.0);
  if (!spectrum) return Propagate(std::move(spectrum));
  FoundSpectrum found;
  found.imported.name = table.Value("Title", column);
  found.imported.spectrum = std::move(*spectrum);
  found.imported.reported = table.Reported(kSekonicLabels, column);
  const auto angle = table.Number("Viewing Angle*", column);
  if (angle && *angle != 2.0) {  // then the instrument's XYZ are those of the 10 degree observer
    found.imported.reported.xy.reset();
    found.imported.reported.xyz.reset();
  }
  found.where = table.file_name();
  found.device = "sekonic";
  found.time = IsoTime(table.Value("Date Saved", column), DateOrder::kYearFirst);
  return found;
}

}  // namespace

bool IsSekonicCsv(std::string_view text) {
  return HasLineStarting(text, kSample) ||
         (HasLineStarting(text, "Measuring Mode,") && HasLineStarting(text, "Illuminance [lx]"));
}

Result<ImportedFile> ReadSekonicCsv(std::string_view text, std::string_view name) {
  const char delimiter = DelimiterOfSamples(text);
  auto rows = ReadRows(text, delimiter);
  if (!rows) return Propagate(std::move(rows));
  LabelledColumns table(std::move(*rows), false, name);
  const SpectralRows spectral = FinestBlock(table.rows());
  if (auto found = table.FindDecimals(spectral, delimiter); !found) {
    return Propagate(std::move(found));
  }
  const auto columns = LabelledColumns::MeasuredColumns(spectral);
  if (columns.empty()) {
    return Refused("bad_spectrum", std::string(name),
                   "holds no spectral samples (Spectral Data 380[nm] ...); the file is cut short");
  }
  std::vector<FoundSpectrum> all;
  Warnings warnings;
  for (const std::size_t column : columns) {
    auto found = ReadSekonicColumn(table, spectral, column);
    if (!found) return Propagate(std::move(found));
    const std::string_view mode = table.Value("Measuring Mode", column);
    const bool ambient = mode.empty() || mode == "Ambient";
    found->imported.spectrum.quantity =
        ambient ? SpectralQuantity::kIrradiance : SpectralQuantity::kRelative;
    if (!ambient) {
      warnings.push_back({"relative_spectrum", found->where,
                          "measured in the mode '" + std::string(mode) +
                              "': an exposure, not an illuminance, so only its colour is used"});
    }
    all.push_back(std::move(*found));
  }
  return ImportedFromSpectra("sekonic_csv", std::move(all), std::move(warnings));
}

}  // namespace lightcal::devices::files
