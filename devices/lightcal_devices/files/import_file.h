// SPDX-License-Identifier: Apache-2.0
// Files that instruments and their apps export -> spectra and readings.
#pragma once

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
  std::optional<Xy> xy;
  std::optional<Xyz> xyz;
  std::optional<double> cri_Ra;
};

struct ImportedSpectrum {
  std::string name;      // column header or title, "" where the file has one spectrum without a name
  Spectrum spectrum;
  ReportedColor reported;
};

struct ImportedFile {
  std::string format;    // "sekonic_csv" "uprtek_xls" "jeti_csv" "tm27_spdx" "argyll_sp" "csv" "actlumus"
  std::vector<ImportedSpectrum> spectra;
  std::vector<Reading> readings;   // scalar readings (logs, plain CSV); light and distance left to the caller
                                   // unless the file names them
  Warnings warnings;     // spectrum_disagrees (names the unit that would make it fit), bad_row, ...
};

// Recognises the format by content (never by extension alone) and reads it whole.
// Fails: not_found, unreadable. Refused: unknown_format (lists what is understood), bad_spectrum,
// no_rows, units_ambiguous.
[[nodiscard]] Result<ImportedFile> ImportFile(const std::string& path);
// The same from bytes; `name` stands in messages.
[[nodiscard]] Result<ImportedFile> ImportBytes(std::string_view bytes, std::string_view name);

}  // namespace lightcal
