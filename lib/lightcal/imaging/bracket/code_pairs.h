// SPDX-License-Identifier: Apache-2.0
// What codes two frames show in one pixel, and the least squares that make a curve of them.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightcal/core/view2d.h"

namespace lightcal {

inline constexpr int kCodeSteps = 256;
inline constexpr double kLeastStep = 0.5;  // ln of a step has no end at 0
inline constexpr int kLowestStep = 3;      // below, noise is cut off at black
inline constexpr int kCurveTurns = 5;      // of weights, after half of which residuals are trusted

using CodeView = View2d<const std::uint16_t>;

// Where a code lies among the steps: codes of 8 bits are steps; of more, steps are finer in the
// dark, where linear codes have most of a scene.
class CodeSteps {
 public:
  explicit CodeSteps(double top) : top_(top), fine_(top > 255.0) {}
  [[nodiscard]] double At(double code) const;
  // Of each code, 0 where it does not count.
  [[nodiscard]] std::vector<int> Nearest() const;
  // How little a curve's slope over ln(step) changes from this step to the next, 1 in the middle:
  // in the toe of 8 bit codes with every ln(step) alike; where steps are fine, by what they are of
  // 8 bit codes.
  [[nodiscard]] double Stiffness(int step) const;
  [[nodiscard]] double top() const { return top_; }

 private:
  double top_;
  bool fine_;
};

// ln of a step; a power law's curve is straight over it.
[[nodiscard]] double LnStep(double step);

// count(a, b): how often one pixel shows step a in frame `first` and step b in frame `second`.
struct CodePair {
  std::size_t first = 0, second = 0;
  std::vector<double> count = std::vector<double>(std::size_t{kCodeSteps} * kCodeSteps, 0.0);
};

// `steps`: of each code, as Nearest.
[[nodiscard]] CodePair CountPair(const CodeView& a, const CodeView& b, int channel,
                                 const std::vector<int>& steps);

// The power law that the search for a curve begins at; the top step is signal 1.
[[nodiscard]] Eigen::VectorXd StartCurve();

// Normal equations of g, ln(signal) over steps, and of d, what ln(exposure) of each frame differs
// by from the one given:
//   min sum n(a, b) w (g(b) - g(a) - (l + d)_second + (l + d)_first)^2 + smoothness of g
//   curve g + mixed d = right,   mixed^T g + exposures d = exposures_right
struct CurveEquations {
  Eigen::MatrixXd curve, mixed, exposures;
  Eigen::VectorXd right, exposures_right;
};

// Weights are those of the curve so far; trust_residuals: small where something moved.
[[nodiscard]] CurveEquations EquationsOf(std::span<const CodePair> pairs,
                                         std::span<const double> ln_exposure,
                                         const CodeSteps& steps, const Eigen::VectorXd& so_far,
                                         bool trust_residuals);

// The nearest increasing curve: neighbours that fall are replaced by their mean.
void MakeIncreasing(Eigen::VectorXd& g);

// Of the pairs, those of neighbours in exposure; `bending`: that differ enough to bend a curve.
[[nodiscard]] std::vector<CodePair> Neighbours(std::span<const CodePair> pairs,
                                               std::span<const double> ln_exposure, bool bending);

// The curve that the pairs tell with these exposures.
[[nodiscard]] Eigen::VectorXd CurveOf(std::span<const CodePair> pairs,
                                      std::span<const double> ln_exposure, const CodeSteps& steps);

}  // namespace lightcal
