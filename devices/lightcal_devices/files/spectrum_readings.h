// SPDX-License-Identifier: Apache-2.0
// The last step of every spectrum importer: check each spectrum against what its file claims, and
// make its reading.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

inline constexpr double kMilliwatt = 1e-3;  // many files' own unit, in W

// A spectrum as a format's reader found it.
struct FoundSpectrum {
  ImportedSpectrum imported;       // values already in W m^-2 nm^-1 where they are an irradiance
  std::string time;                // ISO 8601, "" = unknown
  std::string device;              // "uprtek:CV600 16K00407", "" = unknown
  std::string where;               // "lamp.xls" or "sweep.csv, column 560nm", for messages
};

// One reading per spectrum. Refused: bad_spectrum (fewer than two samples, not finite, wavelengths
// that do not increase; nothing but darkness in the whole file).
// Adds to the reader's own warnings: spectrum_disagrees, color_disagrees, dark_spectrum. Where the
// header's CCT or Duv contradicts its own x, y, the reading carries x, y only.
[[nodiscard]] Result<ImportedFile> ImportedFromSpectra(std::string_view format,
                                                       std::vector<FoundSpectrum> found,
                                                       Warnings warnings = {});

// The warning that a spectrum's own illuminance, 683.002 lm/W times its V(lambda) sum, is off the
// header's by more than 1 % (or half the header's last digit), with the unit that would make it fit
// when one does. Absent when they agree or the header claims nothing.
[[nodiscard]] std::optional<Warning> IlluminanceDisagreement(const FoundSpectrum& found,
                                                             double spectrum_lx);

// The warning that the header's CCT or Duv is not that of its own x, y: off by more than 1 % of the
// CCT or 0.001 in Duv (beyond half a last digit). Instruments print such pairs for narrow-band
// light.
[[nodiscard]] std::optional<Warning> HeaderContradiction(const FoundSpectrum& found);

// The warning that the spectrum's chromaticity is more than 0.003 from the header's x, y.
[[nodiscard]] std::optional<Warning> ColorDisagreement(const FoundSpectrum& found, Xy spectrum_xy);

}  // namespace lightcal::devices::files
