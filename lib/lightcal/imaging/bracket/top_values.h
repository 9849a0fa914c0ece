// SPDX-License-Identifier: Apache-2.0
// The clip of frames that neither name it nor show a spike: a lamp of a few pixels in a
// scene-linear picture. What two frames of different exposure hold alike, or what shorter ones
// foretell far brighter, is as far as the samples go.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lightcal/imaging/bracket/merge_bracket.h"
#include "lightcal/imaging/bracket/signal.h"

namespace lightcal {

// The highest signal of a channel in one frame, and samples that hold it (the first 64).
struct TopValue {
  struct Place {
    int y = 0;
    std::size_t sample = 0;  // of the row
  };
  float value = 0.0F;
  std::vector<Place> places;
};
using FrameTops = std::array<TopValue, 4>;  // of each channel

// Of each frame, over all rows; of channels whose clip is known, nothing.
[[nodiscard]] std::vector<FrameTops> FindTops(std::span<const SignalFrame> frames,
                                              const FrameDone& done = {});

// Sets the clip of channels of which one sample holds the highest signal of the whole bracket in
// two frames, a third of a stop or more apart by their labels.
void ClipHeldTops(std::span<SignalFrame> frames, std::span<const FrameTops> tops,
                  std::span<const double> label);

// Sets the clip of channels whose highest signal the shorter frames together foretell five standard
// deviations brighter, or so much unlike where it is held alike; frames in the plan's order,
// `sd_ln` of their exposures. The brightest such value within 2 % of the bracket's highest.
void ClipContradictedTops(std::span<SignalFrame> frames, std::span<const FrameTops> tops,
                          const MergePlan& plan, std::span<const double> sd_ln);

}  // namespace lightcal
