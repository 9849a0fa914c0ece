// SPDX-License-Identifier: Apache-2.0
// A 95 % interval over its value, as text: the one way it is said everywhere.
#pragma once

#include <string>

#include "lightcal/core/uncertain.h"

namespace lightcal {

// "± 26 %", half its width over the value, where its arms are alike (IsEven); else how far its ends
// lie off the value: "−20 … +31 %". "" where there is no interval, or the value is 0.
[[nodiscard]] std::string RelativeText(const Uncertain& u);

// The interval about 1 of which half the width is u95_relative and half the stops u95_stops;
// infinite: it reaches down to 0.
[[nodiscard]] Uncertain IntervalOfWidths(double u95_relative, double u95_stops);
// The same of a factor that is normal in its logarithm, as a meter's scale is.
[[nodiscard]] Uncertain IntervalOfFactor(double u95_relative);

// In ASCII, for headers of files: "45 cd +- 12 % (95 %)", "45 cd, 20 to 67 cd (95 %)".
[[nodiscard]] std::string PlainInterval(const Uncertain& u, const std::string& unit);

}  // namespace lightcal
