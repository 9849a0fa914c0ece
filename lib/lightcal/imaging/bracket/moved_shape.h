// SPDX-License-Identifier: Apache-2.0
// What really changed between two pictures whose codes came through a recovered curve.
#pragma once

#include "lightcal/imaging/bracket/frame_blocks.h"

namespace lightcal {

// Of `found`, only what has shape. A curve that is a little wrong, quantisation, compression and a
// camera's local tone make pictures of a still scene differ here and there, by levels and along
// edges; what moved is a piece of the picture:
//   - of each level (a dozen, by the blocks of `a`) the median difference is taken off, up to 8 %;
//   - differences are medians of 3 x 3 blocks, and count beyond five robust standard deviations of
//     their level and 2 %;
//   - what a square of 3 x 3 blocks of one sign does not fit into is left out, and so is a piece of
//     fewer than nine blocks or .15 % of those that can be compared.
// `relative` of the answer is what is left of each block's difference.
[[nodiscard]] Differences WithShape(const Differences& found, const Blocks& a);

}  // namespace lightcal
