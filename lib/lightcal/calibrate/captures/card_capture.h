// SPDX-License-Identifier: Apache-2.0
// use = "card": a matt card in the lamp's light -> illuminance and colour.
#pragma once

#include "lightcal/calibrate/captures/capture_reading.h"

namespace lightcal {

// E = pi L F/rho,  L the card's mean luminance in the merged bracket, F the correction for what the
// camera's eyes make of this lamp, rho the card's reflectance. Colour is that of the card, which is
// taken to be neutral. An anchored capture is its lux meter's reading; the picture adds the colour.
// Independent: noise and unevenness of the card's picture. Shared: the scale (ISO speed), F, rho.
// Refused: card_unreadable, card_uneven, bad_region, and as OpenCapture, MergeCapture,
// LuminanceOfLamp.
[[nodiscard]] Result<CaptureReading> ReadCard(const Session& session,
                                              const CaptureDescription& capture,
                                              const Sources& sources, Evidence& evidence);

}  // namespace lightcal
