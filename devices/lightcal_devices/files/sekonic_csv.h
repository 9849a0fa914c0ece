// SPDX-License-Identifier: Apache-2.0
// CSV of Sekonic's meters C-700, C-800, C-7000 and their utility: "Illuminance [lx],30.1", then
// "Spectral Data 380[nm],0.0000..." in W m^-2 nm^-1, first every 5 nm, then every 1 nm.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsSekonicCsv(std::string_view text);
// Reads the finest block of samples. A flash reading (any mode but Ambient) is an exposure, not an
// irradiance: its spectrum is relative, with a warning. Refused: bad_spectrum.
[[nodiscard]] Result<ImportedFile> ReadSekonicCsv(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
