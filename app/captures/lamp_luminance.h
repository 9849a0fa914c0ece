// SPDX-License-Identifier: Apache-2.0
// What a camera makes of a lamp's colour -> its luminance, with what stays unsure.
#pragma once

#include <optional>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

struct LampLuminance {
  double nits = 0.0;
  double sigma = 0.0;    // of the correction, relative
  std::optional<Xy> xy;  // absent where the camera sees no colour
};

// Luminance of what was `seen` (a mean colour in cd/m^2 as ColorOfPicture's matrix has it), on the
// scale that ISO speeds have (daylight) and corrected for the lamp: by the camera's spectral
// sensitivities with the lamp's spectrum or class, else by the mean of 52 cameras for its class.
// With a camera's profile `seen` is as the profile's matrix has it.
// Refused: camera_needs_raw, several_spectra, and as CameraOfCapture, CameraMismatch,
// SpectralCamera::Make.
[[nodiscard]] Result<LampLuminance> LuminanceOfLamp(const Session& session,
                                                    const CaptureDescription& capture,
                                                    const FrameInfo& info,
                                                    const PictureColor& color, const Xyz& seen);

}  // namespace lightcal::app
