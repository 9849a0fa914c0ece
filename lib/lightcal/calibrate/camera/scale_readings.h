// SPDX-License-Identifier: Apache-2.0
// One use = "scale" of a session: what a meter read against what the camera saw.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/imaging/camera/camera_scale.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// what.rect, else the middle ninth.
[[nodiscard]] Region RegionOf(const CameraFramesDescription& what, const MergedBracket& merged);

// k = L/(y F),  L what a spot meter read, rho E/pi of a card, or that for which the picture's
// integral is E; y the profile's luminance of the raw signals per exposure, F its correction for
// the lamp. own_sd holds noise, a third of the patch's unevenness (meter and rect see not quite the
// same), exposures, card and F.
// Refused: patch_unreadable, patch_uneven, picture_clipped, bad_region, bad_view,
// sensitivities_missing.
[[nodiscard]] Result<WeighedScaleReading> ReadScale(Session& session, const Sources& sources,
                                                    const CameraFramesDescription& what,
                                                    const FrameInfo& info,
                                                    const CameraProfile& profile,
                                                    const MergedBracket& merged);

}  // namespace lightcal
