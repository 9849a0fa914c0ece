// SPDX-License-Identifier: Apache-2.0
// Frames whose camera moved between them, brought to one place by whole pixels: no sample is
// interpolated, so that noise stays independent and colours stay on their filters.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/homography.h"
#include "lightcal/imaging/bracket/merge_bracket.h"

namespace lightcal {

struct FrameAlignment {
  // Of each frame of the merge, against the first: how far its picture moved, in pixels to the
  // right and down, as measured and as taken back (whole periods of the colour filter array).
  struct Moved {
    double x = 0.0, y = 0.0, sd = 0.0;
    int taken_back_x = 0, taken_back_y = 0;
    // Where the picture was interpolated: a place of the reference -> of this frame. x, y and the
    // turn are those of the picture's middle.
    std::optional<Homography> from_reference{};
    double turned_deg = 0.0;  // clockwise as one looks at the picture
  };
  std::vector<Moved> moved;
  std::size_t reference = 0;                // the frame that the others are brought to
  int x = 0, y = 0, width = 0, height = 0;  // what all frames show, in the reference's pixels
  bool interpolated = false;
  bool evidence = false;  // some frame differs from its neighbour

  [[nodiscard]] bool any() const;
};

// Compares each frame with the next longer one (see CompareFrames). Frames that agree have not
// moved; a shift counts only where it explains more than half of what disagrees, leaves less than a
// quarter of the blocks disagreeing, and is known to half a pixel both ways: a lamp on black has no
// such evidence and stays where it is. Refused: misaligned (half of the picture disagrees and no
// shift, or none that is certain, explains it: the camera turned or zoomed; or less than half of
// the picture is left).
[[nodiscard]] Result<FrameAlignment> MeasureAlignment(const BracketMerger& merger);

// Whether frames share so little that there is nothing to merge.   Refused: misaligned.
[[nodiscard]] Result<void> CheckShared(int width, int height, const SignalFrame& whole,
                                       const std::string& name);

// The part of each frame that all show. `frames` in the merge's order.
void TakeBack(const FrameAlignment& alignment, std::vector<SignalFrame>& frames);

}  // namespace lightcal
