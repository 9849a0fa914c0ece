// SPDX-License-Identifier: Apache-2.0
// ANSI/IES TM-27 .spdx: XML, any wavelengths, <SpectralQuantity> says what the values are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"
#include "lightcal_devices/files/spectrum_readings.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsTm27Spdx(std::string_view text);

// Its distributions as they are, whatever they are of. Refused as ReadTm27Spdx, but for the
// quantity.
struct Tm27Distribution {
  FoundSpectrum found;
  std::string quantity;  // its SpectralQuantity as written
};
[[nodiscard]] Result<std::vector<Tm27Distribution>> Tm27Distributions(std::string_view text,
                                                                      std::string_view name);

// irradiance is W m^-2 nm^-1; flux, intensity, radiance, exitance and relative give colour only.
// Refused: bad_spectrum (not well-formed XML, a reflectance or transmittance, a value that is no
// number, wavelengths that do not increase).
[[nodiscard]] Result<ImportedFile> ReadTm27Spdx(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
