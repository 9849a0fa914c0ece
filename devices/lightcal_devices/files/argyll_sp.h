// SPDX-License-Identifier: Apache-2.0
// ArgyllCMS .sp: a CGATS table of type SPECT with one spectrum per set. SPECTRAL_BANDS samples from
// SPECTRAL_START_NM to SPECTRAL_END_NM in equal steps; a value is the number written divided by
// SPECTRAL_NORM. MEAS_TYPE "AMBIENT" (spotread -a, illumread) is mW m^-2 nm^-1.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsArgyllSp(std::string_view text);
// EMISSION (a radiance), flashes and files without MEAS_TYPE (illuminant tables) give colour only;
// all but the last warn. Refused: bad_spectrum (reflectance or transmission, fewer values than
// bands, a value that is no number).
[[nodiscard]] Result<ImportedFile> ReadArgyllSp(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
