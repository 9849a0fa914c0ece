// SPDX-License-Identifier: Apache-2.0
// Luminance of a merged bracket's signals: by a spot reading, the camera's profile, or ISO speed.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_bracket.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/imaging/bracket/merge_picture.h"
#include "lightcal/imaging/bracket/prepare_frames.h"

namespace lightcal {

struct PictureScale {
  double nits_per_unit = 0.0;  // luminance of full scale (signal 1) in the shortest frame
  double sd_relative = 0.0;
  // Of an anchored one: what the frames' ISO speed had promised; absent where they name none.
  std::optional<double> iso_nits_per_unit{};
  double anchor_spread = 0.0;  // of an anchored one: the quarters of its place, relative, 1 sd
};

// An anchor four standard deviations off what the ISO speed promises, and what may explain it
// (prior_conflict); one whose place shows unlike light (anchor_uneven).
void WarnOfAnchor(const PictureScale& scale, const std::string& file, Warnings& warnings);

// An anchor comes before a profile's scale, and that before what ISO speeds promise.
// Refused: bad_anchor.
[[nodiscard]] Result<PictureScale> ScaleOf(const BracketMerger& merger,
                                           const PreparedFrames& prepared,
                                           const BracketMergeRequest& request);
[[nodiscard]] ScaleSource ScaleSourceOf(const BracketMergeRequest& request);

// What the merged signals are multiplied by for the picture asked for.
[[nodiscard]] PictureRows RowsOf(const PreparedFrames& prepared, const BracketMergeRequest& request,
                                 double scale);

}  // namespace lightcal
