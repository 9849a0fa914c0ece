// SPDX-License-Identifier: Apache-2.0
// Panorama files -> a dome in cd/m^2 and the lights in it.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/grey_scale.h"
#include "lightcal/imaging/panorama/measure_dome.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// One file in its own projection, on whatever scale it has.
// Refused: as Sources::read_masked_frame, LuminanceOfPicture; over_range (a pixel no scene has).
[[nodiscard]] Result<DomeInput> ReadDomePicture(const std::string& file, const Sources& sources,
                                                const DomeInputRequest& request);

// One lat-long panorama as it is, or views composed to one. Warned: clip_unused (of files whose
// aims are known), bad_samples (besides pixels that hold no number those of negative luminance).
// Refused: no_pictures (no file); as ReadAimedViews where aims are to be found, else as
// Sources::read_masked_frame, LuminanceOfPicture, PixelSolidAngles, ComposeViews; over_range (a
// pixel no scene has), bad_view (a panorama of fewer than four rows, too).
[[nodiscard]] Result<DomeInput> ReadDomeInput(const DomeInputRequest& request,
                                              const Sources& sources);

// A picture that shows a grey ball or card under the dome's light.
struct GreyPlate {
  GreyTarget target;
  // What a plate in its own unit was exposed with: its sample of 1 is the luminance that just
  // saturates (MaximumLuminance), which ISO speeds tell within 39 %.
  std::optional<CameraSettings> exposure;
};

// A dome scaled by a plate is in the plate's own unit: cd/m^2 where the plate is, or as its
// exposure says. Warned: relative_scale (of a plate without either).
// Refused: as ReadDomeInput, MeasureDome, InspectPicture, ScaleByGrey.
[[nodiscard]] Result<MeasuredDome> MeasureDome(const DomeRequest& request, const Sources& sources,
                                               const std::optional<GreyPlate>& plate = {});

}  // namespace lightcal
