// SPDX-License-Identifier: Apache-2.0
// The frames of a planned merge brought to one place, where the camera moved.
#pragma once

#include <span>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/prepare_frames.h"

namespace lightcal {

// Nothing is touched while all frames agree, or lie within .15 pixels of each other. What moved by
// whole periods of the pattern is cut (TakeBack), anything else interpolated (MeasureMotion,
// ResampleFrame); then the merge is planned anew, with a new response of codes. `merge` is what
// `prepared` was planned by, `labels` the exposure of each of its frames as given.
// Refused: misaligned, as MeasureAlignment where MeasureMotion cannot tell either; as
// ResampleFrame, RecoverResponse and PlanMerge.
[[nodiscard]] Result<void> AlignPrepared(MergeRequest merge, std::span<const double> labels,
                                         PreparedFrames& prepared);

}  // namespace lightcal
