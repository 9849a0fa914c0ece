// SPDX-License-Identifier: Apache-2.0
// A frame as its motion is sought in it: what its exposure changes of a scene is a constant there.
#pragma once

#include <cstddef>
#include <vector>

#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// How many cells around one say something: what its slope and an interpolation need.
struct SeenAround {
  bool eight : 1;  // the cell and those next to it
  bool four : 1;   // the cell, the next to the right and those below
  bool cubic : 1;  // those and the twelve around them
};

// Means of cells of `cell` pixels each way.
struct MotionPicture {
  int width = 0, height = 0;
  double cell = 1.0;
  std::vector<float> ln;        // ln(signal); anything where the variance is negative
  std::vector<float> variance;  // of ln; negative: clipped, or drowned in noise
  std::vector<float> around;    // ln of the mean of 5 x 5 cells
  std::vector<SeenAround> seen_around;

  [[nodiscard]] std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

// Finest first, each half of the one before, down to 48 cells on the longer side.
struct MotionPyramid {
  std::vector<MotionPicture> levels;
  double seen = 0.0;  // share of the finest level's cells that say something
};

// Of a cell's channels: their mean, which is the last to drown, and the darkest, the last to clip.
struct MotionPyramids {
  MotionPyramid all, darkest;
  bool full = false;  // a sample of it is, or nobody knows from where on samples are
};

// The finest level is about `longest` cells long at most; whole periods of a colour pattern become
// one cell.   `noise` of one sample, at least: the cells' own (the second difference along rows, of
// all cells as bright) counts where it is more, as of JPEGs nobody knows it.   `floor`: signal
// below which codes say nothing.
[[nodiscard]] MotionPyramids MotionPyramidsOf(const SignalFrame& frame, const NoiseProfile& noise,
                                              double floor, int longest);

}  // namespace lightcal
