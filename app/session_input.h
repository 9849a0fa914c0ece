// SPDX-License-Identifier: Apache-2.0
// From a session on disk to fitted lights: the way `fit`, `run`, `explain` and `report` share.
#pragma once

#include <string>

#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

struct CalibratedSession {
  Session session;   // spectra resolved to colour (and illuminance), captures to readings
  LightFile lights;  // with provenance
};

// Loads the session, resolves `spectrum = "file"` of its readings through the importers and its
// [[capture]]s to readings. Warnings go to the console as they come up.
// With `full_angles` inner_deg and outer_deg are taken as full angles, as some data sheets give
// them.
[[nodiscard]] Result<Session> LoadMeasuredSession(const std::string& path, Console& console,
                                                  bool full_angles = false);

// The same, fitted, with the inputs' hashes.
[[nodiscard]] Result<CalibratedSession> CalibrateSession(const std::string& path,
                                                         const FitSettings& settings,
                                                         Console& console,
                                                         bool full_angles = false);

// Who made an output from what: the session's input files with their hashes, the newest time found
// in its readings (or SOURCE_DATE_EPOCH).  Fails as ReadWholeFile.
[[nodiscard]] Result<Provenance> ProvenanceOf(const Session& session);

// Where a session's outputs go when the person names no place: <session directory>/out.
[[nodiscard]] std::string DefaultOutputDirectory(const Session& session);

// "1%" or "0.01" -> 0.01.
[[nodiscard]] Result<double> ParseTolerance(const std::string& text);

}  // namespace lightcal::app
