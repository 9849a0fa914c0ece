// SPDX-License-Identifier: Apache-2.0
// Pictures -> readings of the session, by the door every reading takes.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// The name that fit.prior lists a scale from ISO speeds under.
inline constexpr const char* kCameraScalePrior = "camera_scale";

// One reading for each [[capture]], after all others, as its use reads it (card_capture, ...). Its
// sigma holds what the picture alone leaves open and, as errors that all captures of one light by
// one camera share, its shared part: m such readings carry sqrt(m) times that each, so that their
// mean is no surer than one camera is.
// Files read are added to session.input_files.
// Refused: as ReadCard.
[[nodiscard]] Result<void> AddCaptureReadings(Session& session, Warnings& warnings);

// Whether nothing but cameras of unmeasured scale says how bright this light is.
[[nodiscard]] bool RestsOnCameraScale(const Session& session, const std::string& light);

}  // namespace lightcal::app
