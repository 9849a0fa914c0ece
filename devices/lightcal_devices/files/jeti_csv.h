// SPDX-License-Identifier: Apache-2.0
// CSV of JETI's spectroradiometer software: ';' between cells, decimal comma, ISO 8859-1, one
// column per measurement named in the row "Input", photometric rows ("Ev [lx] (CIE1931 2 deg)"),
// then from "Wavelength [nm];Ee [W/(sqm*nm)]" on the spectra.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsJetiCsv(std::string_view text);
// A column that is no irradiance (radiance mode, "Le [...]") is relative, with a warning.
// Refused: bad_spectrum.
[[nodiscard]] Result<ImportedFile> ReadJetiCsv(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
