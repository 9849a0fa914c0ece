// SPDX-License-Identifier: Apache-2.0
// What an exposure makes of a lamp that goes on and off.
#pragma once

#include <vector>

#include "lightcal/core/units.h"

namespace lightcal {

// On for `duty` of each period, off for the rest: the worst that pulse width modulation and mains
// do. Mains lamps flicker at twice the mains frequency.
struct LampFlicker {
  double frequency_hz = 100.0;
  double duty = 0.5;  // 0 < duty <= 1
};

// The largest relative error of the light an exposure collects, over all moments it may begin at,
// against the lamp's mean. With n = f t, x its fraction and D the duty:
//   max( min(x, D) - x D,  x D - max(0, x + D - 1) ) / (n D)        <= (1 - D) / n
// 0 for whole periods. Below one period the lamp may be missed (1) or read 1/D - 1 too high.
// Holds for a global shutter; a rolling one shows the same as bands.   f t > 0.
// Source: the integral of a square wave; the bound is the usual rule (50 periods for 1 % at D =
// 1/2).
[[nodiscard]] double WorstFlickerError(const LampFlicker& lamp, Seconds time);

// Dial labels of third stops, shortest first, from `shortest` to 1 s, whose true times (2^(-k/3) s)
// keep that error within `tolerance`.
[[nodiscard]] std::vector<Seconds> FlickerSafeLabels(const LampFlicker& lamp, double tolerance,
                                                     Seconds shortest);

}  // namespace lightcal
