// SPDX-License-Identifier: Apache-2.0
// A picture of which n x n blocks become one: less work, the same signals.
#pragma once

#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// How a picture is made smaller. A block is one period of the colour filter's (and black level's)
// pattern; n x n of them become one, place by place of the pattern, so that what stands where
// stays.
struct Thinning {
  int n = 1;                  // 1: the picture as it is
  bool averaged = false;      // the mean of the n x n blocks; false: the first of them
  int columns = 1, rows = 1;  // of a block
  int width = 0, height = 0;  // of the smaller picture

  // Where the middle of its column x (row y) lies in the whole picture; pixel centres are at .5.
  [[nodiscard]] double WholeX(int x) const { return Whole(x, columns); }
  [[nodiscard]] double WholeY(int y) const { return Whole(y, rows); }
  // The column x (row y) of the smaller picture that a coordinate of the whole one falls on: the
  // line through WholeX, without its steps inside a block.
  [[nodiscard]] double ThinX(double whole_x) const { return Thin(whole_x, columns); }
  [[nodiscard]] double ThinY(double whole_y) const { return Thin(whole_y, rows); }

 private:
  [[nodiscard]] double Whole(int at, int period) const;
  [[nodiscard]] double Thin(double whole, int period) const;
};

// What `choice` makes of pictures like `info`; n = 1 where the picture is smaller than n blocks.
[[nodiscard]] Thinning ThinningOf(const FrameInfo& info, const PictureChoice& choice);

// The first of the n x n blocks each: samples as they were read, so noise, clip and colour stay.
[[nodiscard]] Frame ThinFrame(const Frame& frame, const Thinning& thinning);

// Frame and signals become the mean of n x n blocks each, in float: no rounding to codes. A mean of
// which one sample reaches the clip (kClippedFrom of it) becomes the clip: half of a lamp is no
// dimmer lamp. Noise of one sample becomes noise / n^2 (MergeRequest::samples_averaged says so to
// the plan). `signals` are those of `frame`, their clip found (FindClipping).
void AverageFrame(const Thinning& thinning, Frame& frame, SignalFrame& signals);

// The part of the smaller picture that shows nothing but `region`; at least one block.
[[nodiscard]] Region ThinRegion(const Region& region, const Thinning& thinning);

}  // namespace lightcal
