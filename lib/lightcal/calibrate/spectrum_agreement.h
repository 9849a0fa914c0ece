// SPDX-License-Identifier: Apache-2.0
// Whether what is written beside a spectrum can be of the same light.
#pragma once

#include "lightcal/calibrate/session_files.h"
#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal {

// What a reading's own words contradict in the spectrum that it names:
//   spectrum_disagrees: its illuminance and that of the spectrum, an irradiance, differ by more
//     than two meters may, 2 sqrt(s^2 + 0.05^2), s what the reading, or else its meter, says of
//     itself (1 sigma); with the unit of either that would make them agree where one does;
//   color_disagrees: its x, y, or its CCT and Duv (the spectrum's where it says none), lie farther
//     than 0.01 in x, y from the spectrum's, three times what a colorimeter is off by.
// A number that the file itself claims is compared where the file is read (spectrum_readings.h).
// Subject: the light. Those of one light, of one kind and with one remedy are said once.
void WarnOfDisagreement(const Session& session, const SessionReading& row,
                        const ImportedSpectrum& imported, const Xyz& spectrum, Warnings& warnings);

}  // namespace lightcal
