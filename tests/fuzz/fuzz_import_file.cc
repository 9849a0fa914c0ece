// SPDX-License-Identifier: Apache-2.0
// An instrument's file that is taken gives spectra that can be integrated or refused, never NaN.
#include <cmath>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal_devices/files/import_file.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto imported = lightcal::devices::ImportBytes(lightcal::fuzz::TextOf(data, size), "file");
  if (!imported) {
    Require(!imported.error().code.empty() && !imported.error().message.empty());
    return 0;
  }
  for (const auto& one : imported->spectra) {
    const auto xyz = lightcal::XyzFromSpectrum(one.spectrum);
    Require(!xyz || (std::isfinite(xyz->X) && std::isfinite(xyz->Y) && std::isfinite(xyz->Z)));
  }
  for (const auto& reading : imported->readings) {
    Require(!reading.illuminance || std::isfinite(reading.illuminance->value()));
  }
  return 0;
}
