// SPDX-License-Identifier: Apache-2.0
// What stands out of a lat-long panorama: the sun, lamps, small windows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/latlong_grid.h"

namespace lightcal {

// One body: the pixels it shines from, its blurred edge included.
struct BrightBody {
  std::vector<std::int32_t> pixels;  // ascending
  double peak_nits = 0.0;
  int plateau = 0;       // pixels that share the peak's value exactly: a clipped picture has many
  bool clipped = false;  // some pixel is marked as clipped
};

struct BodySearch {
  // Pixels that hold no more than a lower bound; 1 = clipped. Empty: none is. Of a body with
  // clipped pixels only these and their edge are taken: what else shines there cannot be told.
  std::span<const std::uint8_t> clipped;
  // A body brings at least this share of the integral of L dOmega over the sphere.
  double least_share = 1e-3;
  // Whether all that is clipped is a body, however little of it the picture shows.
  bool clipped_always = false;
};

// Bodies by the flux they have above their edge, largest first; no pixel is in two of them.
//
//   local background B: the 70th percentile of the medians of 3 degree cells within 25 degrees, so
//   a
//     body may fill a quarter of that neighbourhood (27 degrees across) and still stand out;
//   a body's peak is at least 6 B; it grows downhill to 2 B (a watershed on the sphere, across seam
//     and poles); two peaks are two bodies when the saddle between them is below 2/3 of the lower
//     one;
//   its edge is where the luminance stops falling faster than r^-2.5, r the radius of the disc of
//     equal solid angle, below a tenth of the peak: a disc ends at its rim although the sky around
//     glows, a blurred lamp is followed into its background.
// Holds for finite luminances whose rows follow each other without gaps.
[[nodiscard]] std::vector<BrightBody> FindBrightBodies(View2d<const float> nits,
                                                       const LatLongGrid& grid,
                                                       const BodySearch& search = {});

}  // namespace lightcal
