// SPDX-License-Identifier: Apache-2.0
// Units a spectral irradiance comes in.
#pragma once

#include <cstddef>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/units.h"

namespace lightcal {

enum class SpectralUnit {
  kWatts,       // W m^-2 nm^-1
  kMilliwatts,  // mW m^-2 nm^-1
  kMicrowatts,  // uW m^-2 nm^-1; 1 uW cm^-2 nm^-1 is 10 mW m^-2 nm^-1
  kQuanta,      // umol m^-2 s^-1 nm^-1, photons as plant science counts them
};

// Molar energy of photons times wavelength, N_A h c = 0.119 626 565 J m/mol (exact by the SI).
inline constexpr double kMolarPhotonEnergyJouleMetre = 6.02214076e23 * 6.62607015e-34 * 299792458.0;

// W m^-2 nm^-1 of one such unit:  1, 1e-3, 1e-6;  quanta: 1e-6 N_A h c / l = 119.627/l[nm].
// Holds for wavelength > 0.
[[nodiscard]] constexpr double WattsOfUnit(SpectralUnit unit, Nanometres wavelength) {
  switch (unit) {
    case SpectralUnit::kMilliwatts:
      return 1e-3;
    case SpectralUnit::kMicrowatts:
      return 1e-6;
    case SpectralUnit::kQuanta:
      return 1e-6 * kMolarPhotonEnergyJouleMetre / (wavelength.value() * 1e-9);
    case SpectralUnit::kWatts:
      break;
  }
  return 1.0;
}

// The spectrum, whose values are in `unit`, as an irradiance in W m^-2 nm^-1.
[[nodiscard]] inline Spectrum IrradianceFrom(Spectrum spectrum, SpectralUnit unit) {
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    spectrum.values[i] *= WattsOfUnit(unit, Nanometres(spectrum.wavelengths_nm[i]));
  }
  spectrum.quantity = SpectralQuantity::kIrradiance;
  return spectrum;
}

}  // namespace lightcal
