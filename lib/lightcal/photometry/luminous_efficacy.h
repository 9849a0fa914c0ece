// SPDX-License-Identifier: Apache-2.0
// From watts to lumens. Four things that the word "efficacy" or the letter V mixes up are four
// types here: radiant power, electrical power, the eye's weight V(lambda), and a lamp's overall
// efficiency.
#pragma once

#include <cstddef>
#include <span>

#include "lightcal/core/units.h"

namespace lightcal {

using RadiantWatts = Quantity<struct RadiantPowerKind>;        // radiant flux
using ElectricalWatts = Quantity<struct ElectricalPowerKind>;  // drawn from the supply
using WattsPerSteradian = Quantity<struct RadiantIntensityKind>;
// V(lambda) of CIE 018:2019, 0..1, 1 near 555 nm: a property of the eye at one wavelength.
using PhotopicWeight = Quantity<struct PhotopicWeightKind>;
// Lumens of a lamp per 683.002 lm/W of electrical power, 0..1: a property of a lamp.
using OverallEfficiency = Quantity<struct OverallEfficiencyKind>;

// K_cd: exact at 540 THz (555.017 nm in air), the definition of the candela. SI Brochure, 9th ed.
inline constexpr LumensPerWatt kEfficacyAt540THz{683.0};
// K_m = K_cd / V(540 THz): the maximum for photopic vision.   CIE 018:2019; BIPM Principles
// governing photometry (2019), 5.1. V there is 683/683.002.
inline constexpr LumensPerWatt kMaximumEfficacy{683.002};
inline constexpr PhotopicWeight kPhotopicWeightAt540THz{683.0 / 683.002};

// Luminous flux of monochromatic radiation: Phi = K_m V(lambda) Phi_e.
// 1 W is 683 lm only at 540 THz.
[[nodiscard]] constexpr Lumens LumensFromRadiant(RadiantWatts flux, PhotopicWeight v) {
  return Lumens(kMaximumEfficacy.value() * v.value() * flux.value());
}
// Luminous intensity of monochromatic radiation: I = K_m V I_e. One candela at 540 THz is
// 1/683 W per steradian, so 4 pi/683 W in all directions.
[[nodiscard]] constexpr Candela CandelaFromRadiant(WattsPerSteradian intensity, PhotopicWeight v) {
  return Candela(kMaximumEfficacy.value() * v.value() * intensity.value());
}
// Holds for V > 0.
[[nodiscard]] constexpr WattsPerSteradian RadiantFromCandela(Candela i, PhotopicWeight v) {
  return WattsPerSteradian(i.value() / (kMaximumEfficacy.value() * v.value()));
}

// Luminous flux of a lamp: Phi = eta P, P the electrical power, eta the lamp's luminous efficacy.
// Source: CIE e-ILV, "luminous efficacy of a source". The radiant flux is not P.
[[nodiscard]] constexpr Lumens LumensFromElectrical(ElectricalWatts power, LumensPerWatt efficacy) {
  return Lumens(efficacy.value() * power.value());
}
// Holds for efficacy > 0.
[[nodiscard]] constexpr ElectricalWatts ElectricalFromLumens(Lumens flux, LumensPerWatt efficacy) {
  return ElectricalWatts(flux.value() / efficacy.value());
}
// eta/K_m, and back.   Source: CIE e-ILV, "luminous efficiency"; data sheets give it in percent.
[[nodiscard]] constexpr OverallEfficiency EfficiencyFromEfficacy(LumensPerWatt efficacy) {
  return OverallEfficiency(efficacy / kMaximumEfficacy);
}
[[nodiscard]] constexpr LumensPerWatt EfficacyFromEfficiency(OverallEfficiency efficiency) {
  return kMaximumEfficacy * efficiency.value();
}

// What a sampled spectral power [W/nm] is worth: the integrals by the trapezoidal rule,
//   Phi_e = int S dl      Phi = K_m int S V dl
struct SpectralFlux {
  RadiantWatts radiant;
  Lumens luminous;
};
// v_of_nm: callable, wavelength in nm -> V(lambda). Samples at increasing wavelengths, as many
// values as wavelengths; fewer than two give 0.
template <class PhotopicFunction>
[[nodiscard]] SpectralFlux FluxFromSpectralPower(std::span<const double> wavelengths_nm,
                                                 std::span<const double> watts_per_nm,
                                                 PhotopicFunction v_of_nm) {
  double radiant = 0.0;
  double weighted = 0.0;
  for (std::size_t i = 1; i < wavelengths_nm.size(); ++i) {
    const double half_step = (wavelengths_nm[i] - wavelengths_nm[i - 1]) / 2.0;
    radiant += half_step * (watts_per_nm[i - 1] + watts_per_nm[i]);
    weighted += half_step * (watts_per_nm[i - 1] * v_of_nm(wavelengths_nm[i - 1]) +
                             watts_per_nm[i] * v_of_nm(wavelengths_nm[i]));
  }
  return {RadiantWatts(radiant), Lumens(kMaximumEfficacy.value() * weighted)};
}

// Luminous efficacy of radiation, K = Phi/Phi_e; at most K_m. Holds for Phi_e > 0.
[[nodiscard]] constexpr LumensPerWatt EfficacyOfRadiation(const SpectralFlux& flux) {
  return LumensPerWatt(flux.luminous.value() / flux.radiant.value());
}

}  // namespace lightcal
