// SPDX-License-Identifier: Apache-2.0
// Views of one place, turned until the features they share lie on one another: the rows of that
// least-squares problem.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "lightcal/imaging/panorama/lens_bearing.h"

namespace lightcal {

using AimVector = Eigen::VectorXd;
using AimMatrix = Eigen::MatrixXd;

inline constexpr int kAimLensParameters = 3;

// A feature that views a and b share, and the plane in which its misfit is measured.
struct AimMatch {
  std::size_t a = 0, b = 0;
  std::array<double, 2> at_a{}, at_b{};
  Eigen::Vector3d across = Eigen::Vector3d::Zero(), along = Eigen::Vector3d::Zero();
  double weight = 1.0;
};

// Parameters: a turn of every view in the place's axes, then ln f, a, b. A turn w is the rotation
// of Gibbs's vector g = w/2, by 2 atan |g| about g: v + 2 g x (v + g x v)/(1 + g^2).
struct AimBundle {
  PictureView view;
  std::vector<Eigen::Matrix3d> turns;  // place from camera, at turn 0
  std::vector<AimMatch> matches;
  double ln_focal = 0.0, ln_focal_sd = 1.0;  // prior
  double sd_px = 1.0;

  [[nodiscard]] int Lens() const { return 3 * static_cast<int>(turns.size()); }
  [[nodiscard]] int Size() const { return Lens() + kAimLensParameters; }
  [[nodiscard]] int Rows() const {
    return 2 * static_cast<int>(matches.size()) + Size() - Lens() + 3;
  }
};

// Rows over their sd, weights' roots in them; then the lens's priors and the gauge.
struct AimRows {
  using Scalar = double;
  enum : int { NUM_PARAMETERS = Eigen::Dynamic, NUM_RESIDUALS = Eigen::Dynamic };
  const AimBundle& bundle;

  [[nodiscard]] int NumParameters() const { return bundle.Size(); }
  [[nodiscard]] int NumResiduals() const { return bundle.Rows(); }

  bool operator()(const double* at, double* residuals, double* jacobian) const;
};

// In the place's axes, where view a sees it.
[[nodiscard]] Eigen::Vector3d AimDirection(const AimBundle& bundle, const AimMatch& match,
                                           const AimVector& at);

// Two coordinates of a match's misfit, in pixels of the picture's middle.
[[nodiscard]] std::array<double, 2> AimMisfit(const AimBundle& bundle, const AimMatch& match,
                                              const AimVector& at);

// The planes of the misfits, at the directions that are seen now.
void SetAimTangents(AimBundle& bundle, const AimVector& at);

// Robust sd of a coordinate, by the median; weights by Cauchy's loss.
void ReweighAims(AimBundle& bundle, const AimVector& at);

// The turns become part of the views' own.
void FoldAimTurns(AimBundle& bundle, AimVector& at);

}  // namespace lightcal
