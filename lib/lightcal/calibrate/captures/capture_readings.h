// SPDX-License-Identifier: Apache-2.0
// Pictures -> readings of the session, by the door every reading takes.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

struct CaptureReadings {
  std::vector<SessionReading> readings;
  std::vector<LightDescription> lights;      // the session's, with sizes that pictures gave
  std::vector<CaptureDescription> captures;  // the session's, with what their pictures told
};

// One reading for each [[capture]] of use card, source or dome, as its use reads it. Its sigma
// holds what the picture alone leaves open and the scale that it shares: with a lux meter's other
// readings where one was held to the card, else with the same camera's other captures of the light.
// Refused: as ReadCard, ReadSource, ReadDomeCapture.
[[nodiscard]] Result<CaptureReadings> ReadCaptures(const Session& session, const Sources& sources,
                                                   Evidence& evidence);

// Whether nothing but cameras of unmeasured scale says how bright this light is.
[[nodiscard]] bool RestsOnCameraScale(const Session& session, const std::string& light);

}  // namespace lightcal
