// SPDX-License-Identifier: Apache-2.0
// A picture of which only every n-th block is kept: less work, the same signals.
#pragma once

#include "lightcal/imaging/patches.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// Blocks of the colour filter's (and black level's) pattern, every n-th both ways, joined to a
// picture of their own: what is kept is as it was read, so noise, clip and colour stay, and flat
// places keep their mean. n = 1 gives the frame itself. n >= 1.
[[nodiscard]] Frame ThinFrame(const Frame& frame, int n);

// The part of the thinned picture that shows nothing but `region`; at least one pixel.
[[nodiscard]] Region ThinRegion(const Region& region, int n);

}  // namespace lightcal
