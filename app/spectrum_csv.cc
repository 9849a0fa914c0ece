// SPDX-License-Identifier: Apache-2.0
#include "spectrum_csv.h"

#include <cstddef>

#include "lightcal/core/numbers_text.h"
#include "output_files.h"

namespace lightcal::app {

std::string SpectrumCsv(const Spectrum& spectrum, const std::string& what, bool absolute) {
  const bool lux = spectrum.quantity == SpectralQuantity::kIrradiance && absolute;
  std::string text = "# written by " + GeneratorName() + ": spectrum " + what + "\n";
  text += lux ? "wavelength_nm,irradiance_W_m2_nm\n" : "wavelength_nm,relative\n";
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    text +=
        ShortestText(spectrum.wavelengths_nm[i]) + "," + ShortestText(spectrum.values[i]) + "\n";
  }
  return text;
}

}  // namespace lightcal::app
