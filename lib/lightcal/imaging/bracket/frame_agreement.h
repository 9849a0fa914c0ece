// SPDX-License-Identifier: Apache-2.0
// Do the frames of a bracket show the same scene?
#pragma once

#include <cstddef>
#include <span>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_bracket.h"

namespace lightcal {

// Compares each frame with the next longer one, block by block (about 750 blocks across), at the
// plan's exposures. A block disagrees when its means differ by more than six standard deviations
// and 2 %. From 0.1 % of the comparable blocks on (and four of them) the frame is named:
//   misaligned     a shift of more than `tolerated_pixels` explains more than half of the blocks
//   flicker        whole rows differ, columns do not: a rolling shutter under a pulsed lamp
//   moved_content  a part of the picture moved or changed its brightness (says where); of frames
//                  whose codes came through a recovered curve only what has shape (moved_shape.h)
// One warning a kind, about the frame that is worst; it counts and names the others.
// The merged picture is still made: where frames contradict each other its sigma is wide.
// `done_with` is called, from any thread, when all of a frame has been read.
inline constexpr double kLeastShiftPixels = 0.4;
[[nodiscard]] Warnings CompareFrames(const BracketMerger& merger,
                                     double tolerated_pixels = kLeastShiftPixels,
                                     const FrameDone& done_with = {});

}  // namespace lightcal
