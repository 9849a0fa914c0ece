// SPDX-License-Identifier: Apache-2.0
// How a camera moved between two frames of one scene.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/imaging/bracket/homography.h"
#include "lightcal/imaging/bracket/motion_pyramid.h"

namespace lightcal {

struct PairMotion {
  Homography to_other;     // a place of the first frame -> of the other, pixels
  double sd_pixels = 0.0;  // root mean square over the picture, one standard deviation
  double unlike = 0.0;     // share of the evidence that this motion does not explain: people, depth
};

// Where turned (to 3 degrees) and shifted (to an eighth of the picture) pictures look alike, most
// so first, no two within a cell of each other; none where too little of both can be compared.
// Their correlation, of 1.
struct RoughMotion {
  Homography to_other;
  double alike = 0.0;
};
[[nodiscard]] std::vector<RoughMotion> SearchMotion(const MotionPyramid& frame,
                                                    const MotionPyramid& other, double width,
                                                    double height);

// Of the start: within parts of a finest cell of the answer, or cells of the coarsest.
enum class StartIs { kRough, kClose };

// The homography that makes ln(signal) of both agree but for a constant and a gain in each tile of
// 24 cells (so that neither exposure, nor a wrong response, nor the lens's fall-off counts):
//   sum_tiles sum w psi(r) z = 0,  r = ln B(H x) - ln A(x) - c_tile - m_tile ln A(x),
//   w = 1/(var ln A + var ln B + model),  z: slopes of A alone, an instrument
// by Newton's method from coarse to fine with Geman and McClure's psi, so that what moved by itself
// does not count. Noise pulls nowhere (Steering in motion_tiles.h). Weak priors keep what few edges
// leave open near what hands do: shear and aspect .01, perspective .1 a half diagonal. The
// covariance is the tiles' own (Huber's sandwich, each tile left out once): errors that neighbours
// share are in it, and Student's factor of how many carry it. Absent: nothing to align by (a smooth
// or dark picture), or no convergence. Source: Baker & Matthews, IJCV 56 (2004); White,
// Econometrica 48 (1980).
[[nodiscard]] std::optional<PairMotion> RefineMotion(const MotionPyramid& frame,
                                                     const MotionPyramid& other, double width,
                                                     double height, const Homography& start,
                                                     StartIs start_is);

}  // namespace lightcal
