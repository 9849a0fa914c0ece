// SPDX-License-Identifier: Apache-2.0
// The spectrum of a fixture at a state that nobody read: what its emitters mix to its colour.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// A state whose mixture is known, as it lies from the one asked for.
struct MixtureNear {
  std::vector<double> offset;   // one a control, in parts of its range
  std::vector<double> amounts;  // of 1 lx
};

struct MixedSpectrum {
  Spectrum spectrum;        // W m-2 nm-1 of 1 lx
  std::vector<double> u95;  // of each value, its illuminance held
  std::vector<double> amounts;
};

// Of the spectra of 1 lx that are sums of `emitters` and nowhere negative the one nearest to the
// chromaticity of `color`, of those (three numbers tell no more than three amounts) the one nearest
// to what the states around say: a plane through their amounts, by weighted least squares, weights
// falling with the fourth power of the distance. Without a chromaticity the plane alone. An amount
// may fall below 0 where an emitter found holds some of another, as long as no wavelength does. u95
// holds the colour's interval, how far the states around stray from the plane, and what mixtures
// leave of the readings. Absent where no such sum has light.
[[nodiscard]] std::optional<MixedSpectrum> MixEmitters(const FixtureEmitters& emitters,
                                                       const FittedColor& color,
                                                       const std::vector<MixtureNear>& around);

// The point of the line through two emitters' chromaticities that is nearest to `wanted` in x, y:
// all that the two can make (Grassmann's law). How far out they lie themselves no mixture tells.
[[nodiscard]] Xy OnLineOf(Xy a, Xy b, Xy wanted);

// W m-2 nm-1 that give so many lx; all 0 where it has no light.
[[nodiscard]] Spectrum SpectrumOfLux(Spectrum spectrum, double lux);

// answer.spectrum of a state that was read, as it was read; nothing where it was not.
void AddSpectrumRead(const FittedLight& light, const MeasuredState& read, StateAnswer& answer);
// answer.spectrum by MixEmitters; nothing of a lamp whose emitters are not known. Of two emitters a
// colour more than .002 (x, y) beside their line becomes the nearest on it, its interval as wide as
// before. presets/scripts/blender_addon/states.py says the same.
void AddSpectrumBetween(const FittedLight& light, const std::vector<MixtureNear>& around,
                        StateAnswer& answer);

}  // namespace lightcal::fit
