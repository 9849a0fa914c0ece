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

// The name that fit.prior lists a scale from ISO speeds under.
inline constexpr const char* kCameraScalePrior = "camera_scale";

struct CaptureReadings {
  std::vector<SessionReading> readings;
  std::vector<LightDescription> lights;      // the session's, with sizes that pictures gave
  std::vector<CaptureDescription> captures;  // the session's, with what their pictures told
};

// One reading for each [[capture]] of use card, source or dome, as its use reads it. Its
// sigma holds what the picture alone leaves open and, as errors that all captures of one light by
// one camera share, its shared part: m such readings carry sqrt(m) times that each, so that their
// mean is no surer than one camera is.
// Refused: as ReadCard, ReadSource, ReadDomeCapture.
[[nodiscard]] Result<CaptureReadings> ReadCaptures(const Session& session, const Sources& sources,
                                                   Evidence& evidence);

// Whether nothing but cameras of unmeasured scale says how bright this light is.
[[nodiscard]] bool RestsOnCameraScale(const Session& session, const std::string& light);

}  // namespace lightcal
