// SPDX-License-Identifier: Apache-2.0
// The frames of one scene, in order of exposure, with exposures that can be trusted.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// What a person says against the files; recorded in the frames (exposure.overridden).
struct BracketOverrides {
  std::vector<Seconds> exposure;  // one a file, in the order of the files; empty = from the files
  std::optional<double> f_number;
  std::optional<double> t_stop;  // of the two that one stands which is given
  std::optional<double> iso;
};

struct Bracket {
  std::vector<FrameInfo> frames;  // shortest exposure first; frames without a time keep file order
  // duplicate_frame (left out), repeated_exposure, mixed_iso, mixed_aperture, mixed_focus,
  // no_exposure_time, exposure_tags_disagree, lens_shading_not_applied
  Warnings warnings;
};

}  // namespace lightcal
