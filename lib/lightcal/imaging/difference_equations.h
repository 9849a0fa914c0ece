// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace lightcal {

// Measured differences x_b - x_a = d between unknowns, as the normal equations N x = r of
//   min sum w (x_b - x_a - d)^2
// They leave the common level open: N is singular until one unknown is fixed.
struct DifferenceEquations {
  explicit DifferenceEquations(Eigen::Index unknowns)
      : normal(Eigen::MatrixXd::Zero(unknowns, unknowns)), right(Eigen::VectorXd::Zero(unknowns)) {}

  void Add(Eigen::Index a, Eigen::Index b, double difference, double weight) {
    normal(a, a) += weight;
    normal(b, b) += weight;
    normal(a, b) -= weight;
    normal(b, a) -= weight;
    right(b) += weight * difference;
    right(a) -= weight * difference;
  }

  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
};

}  // namespace lightcal
