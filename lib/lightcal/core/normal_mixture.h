// SPDX-License-Identifier: Apache-2.0
// What may be one of several things, each of them normal.
#pragma once

#include <span>

#include "lightcal/core/uncertain.h"

namespace lightcal {

struct NormalPart {
  double weight = 1.0;
  double mean = 0.0;
  double sd = 0.0;
};
// The value below which a part `probability` of the mixture lies.
[[nodiscard]] double QuantileOf(std::span<const NormalPart> mixture, double probability);
// Of a variable whose logarithm is such a mixture: its median and the 95 % between its quantiles.
[[nodiscard]] Uncertain UncertainFromLogMixture(std::span<const NormalPart> of_ln);

}  // namespace lightcal
