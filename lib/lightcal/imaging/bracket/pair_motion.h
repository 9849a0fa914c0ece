// SPDX-License-Identifier: Apache-2.0
// How a camera moved between two frames of one scene.
#pragma once

#include <optional>

#include "lightcal/imaging/bracket/homography.h"
#include "lightcal/imaging/bracket/motion_pyramid.h"

namespace lightcal {

struct PairMotion {
  Homography to_other;     // a place of the first frame -> of the other, pixels
  double sd_pixels = 0.0;  // root mean square over the picture, one standard deviation
  double unlike = 0.0;     // share of the evidence that this motion does not explain: people, depth
};

// Where turned (to 3 degrees) and shifted (to an eighth of the picture) pictures look most alike;
// absent where too little of both can be compared. Its correlation, of 1.
struct RoughMotion {
  Homography to_other;
  double alike = 0.0;
};
[[nodiscard]] std::optional<RoughMotion> SearchMotion(const MotionPyramid& frame,
                                                      const MotionPyramid& other, double width,
                                                      double height);

// The homography that makes ln(signal) of both agree but for a constant in each tile of 24 cells
// (so that neither exposure, nor a wrong response, nor the lens's fall-off counts):
//   min sum_tiles sum w rho(ln B(H x) - ln A(x) - c_tile),  w = 1/(var ln A + var ln B + model)
// by Gauss and Newton's method from coarse to fine with Geman and McClure's rho, so that what moved
// by itself does not count. Weak priors keep what few edges leave open near what hands do: shear
// and aspect .01, perspective .1 a half diagonal. The covariance is the tiles' own (Huber's
// sandwich): errors that neighbours share are in it. Absent: nothing to align by (a smooth or dark
// picture), or no convergence. Source: Baker & Matthews, IJCV 56 (2004); White, Econometrica 48
// (1980).
[[nodiscard]] std::optional<PairMotion> RefineMotion(const MotionPyramid& frame,
                                                     const MotionPyramid& other, double width,
                                                     double height, const Homography& start);

}  // namespace lightcal
