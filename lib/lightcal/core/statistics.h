// SPDX-License-Identifier: Apache-2.0
// Medians and other ranks. All reorder the values they are given, which must not be empty.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lightcal {

// Standard deviations of a normal variable from its median to a quartile.
inline constexpr double kNormalQuartile = 0.6745;
// Its standard deviation over the median of its absolute deviations, 1/Phi^-1(3/4).
inline constexpr double kSdPerMad = 1.4826;
// Scale of Cauchy's loss, in standard deviations, at which it has 95 % of least squares' efficiency
// for normal errors (Holland and Welsch, Commun. Stat. A6, 813 (1977)).
inline constexpr double kCauchyScale = 2.385;

// What would stand at `rank`, below the number of values, if they were sorted.
template <class T>
[[nodiscard]] T AtRank(std::vector<T>& values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The value that `share` of the others lie below, to the nearest rank.
template <class T>
[[nodiscard]] T Quantile(std::vector<T>& values, double share) {
  return AtRank(values,
                static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5));
}

// The middle one; of an even number the upper of the middle two.
template <class T>
[[nodiscard]] T UpperMedian(std::vector<T>& values) {
  return AtRank(values, values.size() / 2);
}

// The middle one; of an even number the mean of the middle two, or the one of them that is finite.
template <class T>
[[nodiscard]] double Median(std::vector<T>& values) {
  const double upper{UpperMedian(values)};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  if (values.size() % 2 == 1) return upper;
  const double lower{*std::max_element(values.begin(), middle)};
  if (!std::isfinite(upper)) return lower;
  return std::isfinite(lower) ? 0.5 * (lower + upper) : upper;
}

}  // namespace lightcal
