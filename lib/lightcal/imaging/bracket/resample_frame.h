// SPDX-License-Identifier: Apache-2.0
// A frame of a camera that moved, as the reference's camera would have seen it.
#pragma once

#include <cstddef>
#include <span>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/homography.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// What all frames show of the reference's picture, `margin` pixels inside each of theirs.
[[nodiscard]] Region SharedRegion(std::span<const Homography> from_reference, int width, int height,
                                  double margin);

// Pixels of a colour pattern after which its filters repeat; 1 where every pixel holds all
// channels.
[[nodiscard]] int ColorPeriod(const SignalFrame& frame);

// `frame` and `signals`, which are one picture, become `region` of the reference: floats, each the
// sum of 4 x 4 samples of its colour with Catmull and Rom's weights (a mosaic's on each of its
// lattices, green the mean of two: three channels at every pixel then). A sum with a clipped sample
// in it is the clip. Its variance is sum w^2 of the samples' (SignalFrame::shares); neighbours
// share noise, so that the mean of many pixels is as sure as the mean of the samples they came
// from. Source: Keys, IEEE ASSP 29 (1981). Refused: pattern_too_wide (filters that do not repeat
// after two pixels).
[[nodiscard]] Result<void> ResampleFrame(const Homography& from_reference, const Region& region,
                                         Frame& frame, SignalFrame& signals);

}  // namespace lightcal
