// SPDX-License-Identifier: Apache-2.0
// Features that views share -> where each camera looked, and the one lens of all.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/match_views.h"
#include "lightcal/records/picture_feature.h"

namespace lightcal {

struct AimQuestion {
  std::vector<std::string> names;  // of the views, for messages
  std::vector<std::vector<PictureFeature>> features;
  PictureView view;  // of every one; field_of_view 0: unknown
};

struct SolvedAims {
  std::vector<CameraAxes> axes;  // the first view's are the unit matrix's
  std::vector<double> u95_deg;   // the angle of each to the truth, after the turn that all share
  double focal_px = 0.0;
  ViewLens lens;
  double rms_px = 0.0;  // robust, of a match's coordinate, in the views' pixels
  std::size_t matches = 0;
};

// With R_i a view's axes, d(p) the direction of a feature at p through the lens (f, a, b shared):
//   minimise  sum rho(|f (R_i^T d(p) - R_j^T d(q))|^2) + priors,   rho Cauchy's,
// over rotations and lens, from the tree of pairs that agree best (each pair's rotation by RANSAC).
// Priors, 1 sigma: ln f 3 % where the field of view is known (else found among 25 to 120 degrees,
// free), a and b .03. Intervals by leaving out fields of 6 degrees, inside which errors are taken
// to be one, and by what a lens may do beside f, a and b: six terms linear and quadratic in the
// place, as large as the residuals make likely. What the likeliest ones would move stays in the
// interval; the aims are those of the lens that is told. Refused: views_do_not_overlap, naming the
// view and what it was held against.
[[nodiscard]] Result<SolvedAims> SolveAims(const AimQuestion& question);

}  // namespace lightcal
