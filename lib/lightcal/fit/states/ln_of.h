// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "lightcal/core/uncertain.h"

namespace lightcal::fit {

// 1 sigma of ln of a positive quantity.
[[nodiscard]] inline double SdOfLn(const Uncertain& u) {
  if (u.low && u.high && *u.low > 0.0) return std::log(*u.high / *u.low) / (2.0 * kZ95);
  return u.value > 0.0 ? u.u95 / (kZ95 * u.value) : 0.0;
}

// Times exp(ln), ln being unsure by sd too; absent where there is nothing to scale.
[[nodiscard]] inline std::optional<Uncertain> Scaled(const std::optional<Uncertain>& reference,
                                                     double ln, double sd) {
  if (!reference) return std::nullopt;
  if (!(reference->value > 0.0)) return std::nullopt;
  return UncertainFromLog(std::log(reference->value) + ln, std::hypot(SdOfLn(*reference), sd));
}

}  // namespace lightcal::fit
