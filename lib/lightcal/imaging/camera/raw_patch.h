// SPDX-License-Identifier: Apache-2.0
// Merged raw signals of a part of a picture: what calibrations of a camera compare with a meter.
#pragma once

#include <array>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/imaging/scene/patches.h"

namespace lightcal {

// Mean red, green and blue of a region.
struct RawPatch {
  std::array<double, 3> rgb{};  // raw signal per unit of exposure t S/N^2
  double noise_sd = 0.0;        // of green's mean, relative
  double uneven_sd = 0.0;       // of the pixels beyond their noise, relative
};

// `merged` by BracketMergeRequest::raw, with sigma.
// Refused: bad_region, patch_unreadable (saturated in every frame, or lost in the noise); `where`
// stands in messages.
[[nodiscard]] Result<RawPatch> MeasureRawPatch(const MergedBracket& merged, const Region& region,
                                               const std::string& where);

// The middle ninth of a picture.
[[nodiscard]] Region MiddleOf(int width, int height);

}  // namespace lightcal
