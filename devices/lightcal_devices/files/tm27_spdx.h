// SPDX-License-Identifier: Apache-2.0
// ANSI/IES TM-27 .spdx: XML, any wavelengths, <SpectralQuantity> says what the values are.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsTm27Spdx(std::string_view text);
// irradiance is W m^-2 nm^-1; flux, intensity, radiance, exitance and relative give colour only.
// Refused: bad_spectrum (not well-formed XML, a reflectance or transmittance, a value that is no
// number, wavelengths that do not increase).
[[nodiscard]] Result<ImportedFile> ReadTm27Spdx(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
