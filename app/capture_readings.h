// SPDX-License-Identifier: Apache-2.0
// Pictures of cards -> readings of the session, by the door every reading takes.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// The name that fit.prior lists a scale from ISO speeds under.
inline constexpr const char* kCameraScalePrior = "camera_scale";

// One reading for each [[capture]], after all others:
//   E = pi L F/rho,  L the card's mean luminance in the merged bracket, F the correction for what
//   the camera's eyes make of this lamp, rho the card's reflectance;
// its sigma holds noise and unevenness of the card's picture, and, as errors that all captures of
// one light by one camera share, the scale (ISO speed), F and rho: m such readings carry sqrt(m)
// times these each, so that their mean is no surer than one camera is. An anchored capture is its
// lux meter's reading; the picture adds the colour.
// Colour is that of the card, which is taken to be neutral.
// Files read are added to session.input_files.
// Refused: card_unreadable, card_uneven, bad_region, camera_needs_raw, not_one_spectrum, and as
// MergeBracketFiles, CameraSensitivitiesFromJson.
[[nodiscard]] Result<void> AddCaptureReadings(Session& session, Warnings& warnings);

// Whether nothing but cameras of unmeasured scale says how bright this light is.
[[nodiscard]] bool RestsOnCameraScale(const Session& session, const std::string& light);

}  // namespace lightcal::app
