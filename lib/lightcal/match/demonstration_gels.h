// SPDX-License-Identifier: Apache-2.0
// Filters by formula, to try matching with before one has makers' figures.
#pragma once

#include "lightcal/records/gel.h"

namespace lightcal::match {

// 22 filters that nobody makes, every 5 nm over 380-780 nm, peak transmittance 0.9:
//   orange and blue: T = 0.9 exp(-c2 M (1/l - 1/l0)), at most 0.9, which moves a black body by M
//     (Wien's law); full, 3/4, 1/2, 1/4, 1/8: M = 159, 120, 81, 42, 20 and -137, -112, -78, -35,
//     -18 mired (the shifts a trade calls so);  l0 = 700 nm and 420 nm
//   minus and plus green: T = 0.9 10^(-D g), 0.9 10^(-D (1 - g)), g = exp(-((l - 540)/50)^2 / 2);
//     full, 1/2, 1/4, 1/8: D = 0.3, 0.15, 0.075, 0.0375 (CC 30, 15, 7.5, 3.75)
//   neutral: T = 10^-D, D = 0.15, 0.3, 0.6, 0.9
[[nodiscard]] GelSet DemonstrationGels();

}  // namespace lightcal::match
