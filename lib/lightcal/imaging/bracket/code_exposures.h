// SPDX-License-Identifier: Apache-2.0
// True exposures of a bracket of codes, beside the curve that its codes came through.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightcal {

class CodeSteps;  // code_pairs.h
struct CodePair;

struct CodeExposures {
  std::vector<double> ln_exposure;  // of each frame, in the labels' unit
  std::vector<double> off;          // of them from the labels' logarithms
  // Of the common factor of all ln ratios, and so of the curve's power (1 sigma): by how much the
  // labels scatter, and where it is not certain which of them is odd. 0 where they agree; of two
  // frames, which tell nothing of their ratio, by kLabelSd of each.
  double power_sd = 0.0;
  double power_reach = 0.0;  // to the farthest power, where nobody's label is odd for certain
  bool certain = true;       // which label is odd, if any
};

// Curve and exposures together, where frames contradict the labels: those under whose best curve
// neighbours differ least. Where few codes are shared a bend of the curve is as good as another
// exposure, so labels stand unless frames differ under them by three times as much. Curve and
// exposures have one ambiguity in common, a power and the same factor on all ln ratios; with it the
// labels are met that no single one (of five and more frames, no two) contradicts: each such choice
// is weighed by how well the others keep to kLabelSd. Two frames keep their labels, and frames that
// share few pixels. Of three the frames tell one number, which the middle one explains by half of
// what either end would need: nobody is odd for certain, and power_reach holds each.
//   accuracy: 1 % with a label wrong by up to 1 EV, on 1e4 pixels
[[nodiscard]] CodeExposures MeasureCodeExposures(std::span<const std::vector<CodePair>> channels,
                                                 const CodeSteps& steps,
                                                 std::span<const double> label);

}  // namespace lightcal
