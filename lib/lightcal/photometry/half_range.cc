// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/half_range.h"

#include <cmath>

namespace lightcal {

HalfRange ClassifyHalf(double value) {
  const double magnitude = std::abs(value);
  if (magnitude == 0.0) return HalfRange::kFits;
  if (!(magnitude <= kLargestHalf)) return HalfRange::kOverflow;
  if (magnitude >= kSmallestNormalHalf) return HalfRange::kFits;
  // Half of the smallest subnormal is a tie and rounds to even, to 0.
  return magnitude > kSmallestSubnormalHalf / 2.0 ? HalfRange::kSubnormal : HalfRange::kUnderflow;
}

std::string_view HalfRangeName(HalfRange range) {
  switch (range) {
    case HalfRange::kFits:
      return "fits";
    case HalfRange::kOverflow:
      return "overflow";
    case HalfRange::kSubnormal:
      return "subnormal";
    case HalfRange::kUnderflow:
      break;
  }
  return "underflow";
}

}  // namespace lightcal
