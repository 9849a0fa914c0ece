// SPDX-License-Identifier: Apache-2.0
// What the spectra that a session names answer for.
#pragma once

#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/calibrate/lamp_spectra.h"
#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// A spectrum answers for the colour of its reading, and for its illuminance where the reading gives
// none and the file's unit is an irradiance. Its steps are made step_nm wide where they are finer.
// Refused: illuminance_ambiguous, and as ReadTheOneSpectrum.
[[nodiscard]] Result<Reading> WithSpectrum(const Session& session, const SessionReading& row,
                                           double step_nm, const Sources& sources,
                                           Evidence& evidence, std::vector<ReadSpectrum>& read);

// Spectra of lamps that captures name, for lights whose readings have none; one that cannot be read
// was reported where it counted.
void AddSpectraOfCaptures(const Session& session, const Sources& sources, Evidence& evidence);

// Each state keeps the spectrum that was read at it, and the lamp that of its own.
void TakeSpectra(const std::vector<NamedSpectrum>& spectra, FittedLight& light);

}  // namespace lightcal
