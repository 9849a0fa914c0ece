// SPDX-License-Identifier: Apache-2.0
// What a file that an instrument or its app exported holds: spectra and readings.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/records/reading.h"

namespace lightcal {

// What the file's own header claims; absent = not claimed (a reported CCT of 0 is absent).
struct ReportedColor {
  std::optional<double> illuminance_lx;
  std::optional<double> cct_K;
  std::optional<double> duv;
  std::optional<Xy> xy;  // CIE 1931 2 degree, as is xyz
  std::optional<Xyz> xyz;
  std::optional<double> cri_Ra;
  std::array<std::optional<double>, 15> cri_R;  // R1 to R15
  std::optional<double> tm30_rf, tm30_rg;
  // One unit of the last digit the file prints, 0 = not claimed: a comparison with a recomputed
  // value cannot be sharper than half of it.
  double illuminance_last_digit_lx = 0.0;
  double cct_last_digit_K = 0.0;
  double duv_last_digit = 0.0;
};

struct ImportedSpectrum {
  std::string name;  // column header or title, "" where the file has one spectrum without a name
  Spectrum spectrum;
  ReportedColor reported;
  std::string where;  // what warnings about it name: "lamp.xls", "sweep.csv, column 560nm"
  double file_unit_W_m2_nm = 1.0;  // what one unit of the file's own values was taken for
};

struct ImportedFile {
  // "sekonic_csv" "uprtek_xls" "jeti_csv" "tm27_spdx" "argyll_sp" "csv" "actlumus"
  std::string format;
  std::vector<ImportedSpectrum> spectra;
  // With spectra: exactly one reading per spectrum, in the same order (illuminance, cct, duv, xy,
  // time, device; the caller sets spectrum_file). Without: the rows of a log or table. Light and
  // distance are left to the caller unless the file names them.
  std::vector<Reading> readings;
  // spectrum_disagrees (names the unit that would make it fit), color_disagrees, dark_spectrum,
  // relative_spectrum, column_ignored, bad_row
  Warnings warnings;
};

// Which spectrum of the file a person means by "560nm" (its name, first) or "19" (its number,
// counted from 1): an index into spectra. Refused: unknown_column (lists the names).
[[nodiscard]] Result<std::size_t> FindSpectrum(const ImportedFile& file, std::string_view column);

// The warning that a header's illuminance is not its spectrum's: neither is a reading then; null
// where they agree.
[[nodiscard]] const Warning* IlluminanceDoubt(const Warnings& warnings);

// The file's warnings without those about its other spectra.
[[nodiscard]] Warnings WarningsAbout(const ImportedFile& file, std::size_t spectrum);

}  // namespace lightcal
