// SPDX-License-Identifier: Apache-2.0
// What exposures measured from pictures say of their labels: which of them are odd.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lightcal {

// Of the curve that codes were read through when exposures were measured: its power is off by `sd`
// (1 sigma, relative), or in one of 1 / odd_share cases by odd_sd.
struct CurvePower {
  double sd = 0.02, odd_sd = 0.3, odd_share = 0.05;
};

// A choice of odd labels: what the others ask for, ln(exposure) found = constant + (1 + factor) of
// the label's, and the logarithm of how probable all labels are then.
struct LabelChoice {
  std::vector<std::size_t> odd;
  bool odd_curve = false;
  double constant = 0.0, factor = 0.0, ln_probability = 0.0;
};

// Of exposures measured, which differ so from labels about 0, all logarithms: no label is odd, one
// is, of five frames and more two are. A factor on all ratios is a power of the curve, and as good
// as any other where no `power` is given.
[[nodiscard]] std::vector<LabelChoice> LabelChoices(std::span<const double> labels,
                                                    std::span<const double> differences,
                                                    const std::optional<CurvePower>& power = {});

// Whether of each label, and of none, it is known to nine tenths that it is odd or that it is not.
inline constexpr double kCertainLabel = 0.9;
[[nodiscard]] bool AreCertain(std::span<const LabelChoice> choices);

// Labels weighed beside exposures that were measured through a curve that is stated.
struct WeighedLabels {
  std::vector<double> off;  // ln of each exposure less its label's
  double gauge_sd = 0.0;    // of what is common to all of them, where no choice is certain
  double power_sd = 0.0;    // of the curve's power, for the same reason
  bool certain = true;      // which label is odd, if any
};
[[nodiscard]] WeighedLabels WeighLabels(std::span<const double> ln_label,
                                        std::span<const double> ln_measured,
                                        const std::vector<bool>& measured, const CurvePower& power);

}  // namespace lightcal
