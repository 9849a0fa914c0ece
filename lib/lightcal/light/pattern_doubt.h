// SPDX-License-Identifier: Apache-2.0
// How unsure it is what a lamp sends off its aim beside what it sends along it.
#pragma once

#include <vector>

namespace lightcal {

// 1 sigma of the intensity in parts of the strength, by the angle from the aim. Straight lines
// between the angles, and beyond the last as there.
struct PatternDoubt {
  std::vector<double> gamma_rad;  // ascending
  std::vector<double> part_sd;

  [[nodiscard]] double At(double gamma) const;
};

// By angles in degrees, of each its part.
[[nodiscard]] PatternDoubt PatternDoubtOf(const std::vector<double>& gamma_deg,
                                          std::vector<double> part_sd);

// Of a spot whose beam nobody knows, taken to shine alike to every side: rms over beams of
//   1 - 2^-(gamma/h)^2,  ln h even between 3 and 60 degrees (full beams of 6 to 120),
// and no more than what it is taken to send there within 95 %.
[[nodiscard]] PatternDoubt DoubtOfAnyBeam();
// Of one whose aim nobody knows either: from dark to twice that, 95 %, in all directions.
[[nodiscard]] PatternDoubt DoubtOfAnyAim();
// 1 sigma of ln of all its light: between the .0089 of 4 pi I that the narrowest of traced lamps
// send (FluxSpreadOf, fit/model/data_sheet.h) and 1, 95 %.
inline constexpr double kAnyBeamLnFluxSd = 1.205;

}  // namespace lightcal
