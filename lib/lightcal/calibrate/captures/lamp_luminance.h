// SPDX-License-Identifier: Apache-2.0
// What a camera makes of a lamp's colour -> its luminance, with what stays unsure.
#pragma once

#include "lightcal/calibrate/captures/capture_reading.h"

namespace lightcal {

// Luminance of what was `seen` (a mean colour in cd/m^2 as picture.color's matrix has it), on the
// scale that ISO speeds have (daylight) and corrected for the lamp: by the camera's spectral
// sensitivities with the lamp's spectrum or class, else by the mean of 52 cameras for its class.
// With a camera's profile `seen` is as the profile's matrix has it.
// Refused: camera_needs_raw, several_spectra, and as CameraMismatch, SpectralCamera::Make.
[[nodiscard]] Result<LampLuminance> LuminanceOfLamp(const Session& session,
                                                    const CaptureDescription& capture,
                                                    const CapturePicture& picture, const Xyz& seen,
                                                    const Sources& sources);

}  // namespace lightcal
