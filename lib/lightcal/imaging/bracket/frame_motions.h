// SPDX-License-Identifier: Apache-2.0
// How a camera in the hand moved through a bracket.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/homography.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/frame.h"

namespace lightcal {

struct FrameMotion {
  Homography from_reference;  // a place of the reference -> of this frame, pixels
  double sd_pixels = 0.0;     // root mean square over the picture, one standard deviation
  double unlike = 0.0;        // share of the evidence that it does not explain: people, depth
  bool left_out = false;      // how the camera moved is not known
  std::string why{};          // it is left out
};

struct BracketMotion {
  std::size_t reference = 0;  // the frame of middle exposure
  std::vector<FrameMotion> frames;
};

// What is known before, and what must be known after.
struct MotionLook {
  const BracketMotion* known = nullptr;  // within a pixel, of the same frames
  bool rough = false;  // places to a pixel will do, and what has none is left out, never refused
};

// Of frames in order of exposure, each of its own noise; `floor`: signal below which codes say
// nothing. Every frame is found against its neighbour in exposure, which shares most of its range
// (SearchMotion, RefineMotion), chained to the reference and refined against that directly where
// this is surer; and back: the middle of both is taken, and half of what they miss each other by is
// in its standard deviation. A frame that cannot be followed is left out where it is longer than
// the reference, less than a fifth of it says anything, or the next longer one that was followed is
// full nowhere, so that it shows nothing more. Refused: misaligned (another frame whose place is
// not known to .3 pixels root mean square at three standard deviations: which, how far
// off, what to do; no frame but the reference was followed).
[[nodiscard]] Result<BracketMotion> MeasureMotion(std::span<const SignalFrame> frames,
                                                  std::span<const NoiseProfile> noise, double floor,
                                                  const MotionLook& look = {});

}  // namespace lightcal
