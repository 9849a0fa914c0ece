// SPDX-License-Identifier: Apache-2.0
// Of the spectra that a session's readings hold, the one that is the lamp's own.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct ReadSpectrum {
  SessionReading row;  // its colour and illuminance resolved
  Spectrum spectrum;   // as its file has it
  SpectralDoubt doubt{};
};

// One a light and state of its controls that was read with no other lamp lit: what a reading and
// the one behind its card differ by, each made its illuminance, where both were read by one meter;
// else that of the reading nearest the lamp, where the walls' light is least; the first of equals.
// None from readings with the lamp off or behind a card. In order of their first reading.
[[nodiscard]] std::vector<NamedSpectrum> LampSpectra(const std::vector<ReadSpectrum>& read);

}  // namespace lightcal
