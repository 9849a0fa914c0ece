// SPDX-License-Identifier: Apache-2.0
// The CIE's illuminants by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Relative spectrum of the black body, 360-830 nm at 1 nm, 100 at 560 nm, c2 = 1.4388e-2 m K.
// Holds for 400 K <= T, infinity included.  Refused: "out_of_range" below.
[[nodiscard]] Result<Spectrum> BlackBodySpectrum(Kelvin temperature);

// A light by its name, in capitals or not:
//   A                      100 (560/l)^5 expm1(1.435e7/(2848 560)) / expm1(1.435e7/(2848 l)),
//                          360-830 nm at 1 nm: the black body of 2855.54 K
//   C, ID50, ID65          CIE tables, 300-780 nm at 5 nm
//   E                      equal energy, 360-830 nm at 1 nm
//   D50, D55, D65, D75 ..  CIE daylight of 5000, 5500 .. times 1.4388/1.4380 K, see daylight.h;
//                          any two or three digits, 4000-25000 K
//   FL1-FL12 (or F1-F12), FL3.1-FL3.15, HP1-HP5, LED-B1-5, LED-BH1, LED-RGB1, LED-V1, LED-V2
//                          CIE tables, 380-780 nm at 5 nm
//   P3200                  the black body of 3200 K, as SSI writes it
// Source: CIE 15:2018, 4 and tables 5-12.
// Refused: "unknown_illuminant" (lists the names), and as DaylightSpectrum and BlackBodySpectrum.
[[nodiscard]] Result<Spectrum> IlluminantSpectrum(std::string_view name);

// The tabulated and defined names: A, C, D50, D55, D65, D75, E, FL1 ...
[[nodiscard]] std::vector<std::string> IlluminantNames();

}  // namespace lightcal
