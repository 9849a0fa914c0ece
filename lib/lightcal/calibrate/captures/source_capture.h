// SPDX-License-Identifier: Apache-2.0
// use = "source": the lamp's own picture -> its intensity, luminance and size.
#pragma once

#include "lightcal/calibrate/captures/capture_reading.h"

namespace lightcal {

// The illuminance that the lamp gives where the camera stood, as MeasureSource sums it, corrected
// for what the camera makes of this lamp: one reading at distance_m. What else lights the room is
// not in it. A disk, sphere, rect or tube whose size the session does not give takes that of its
// luminous face; warned where it gives another: source_size_differs. An anchored capture is its
// lux meter's reading, taken at the camera; the picture adds size and colour, of a clipped
// lamp neither (warned: source_clipped). A face too small for its picture's blur gives no size and
// no luminance: unsized says why where the light's kind needs one (source_unresolved).
// Independent: noise. Shared: the scale (ISO speed), the correction, the field of view (0.5 %).
// Refused: as OpenCapture, MergeCapture, PixelSolidAngles, MeasureSource, LuminanceOfLamp.
[[nodiscard]] Result<CaptureReading> ReadSource(const Session& session,
                                                const CaptureDescription& capture,
                                                const Sources& sources, Evidence& evidence);

// Whether its kind says nothing of a lamp without a size, and none is there.
[[nodiscard]] bool LacksSize(const LightDescription& light);

}  // namespace lightcal
