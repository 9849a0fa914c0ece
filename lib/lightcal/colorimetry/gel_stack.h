// SPDX-License-Identifier: Apache-2.0
// What colour filters in front of a lamp let through, alone and stacked.
#pragma once

#include <array>
#include <span>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"

namespace lightcal {

// A smooth function of wavelength on 380-780 nm: its values every 5 nm, straight between them, the
// end values beyond. Gels are: makers tabulate them every 5 or 10 nm.
inline constexpr int kNodeFirstNm = 380;
inline constexpr int kNodeStepNm = 5;
inline constexpr int kNodeCount = 81;
using NodeValues = std::array<double, kNodeCount>;

[[nodiscard]] constexpr double NodeNm(std::size_t node) {
  return kNodeFirstNm + kNodeStepNm * static_cast<double>(node);
}
[[nodiscard]] double AtNodes(const NodeValues& values, double nm);

// A gel as tabulated, brought to the nodes: linear between its samples, held at its ends.
// known_from and known_to: the nodes the table covers; what lies outside is not known, and whoever
// states an interval carries it there. Holds for two or more samples at increasing wavelengths.
struct GelNodes {
  NodeValues transmittance{};
  int known_from = 0, known_to = kNodeCount - 1;
};
[[nodiscard]] GelNodes GelAtNodes(std::span<const double> nm, std::span<const double> values);

// What lies between two sheets.
enum class SheetGap {
  kNone,  // T = T1 T2: makers' transmittances already hold both faces of each sheet
  kAir,   // and light thrown to and fro between the sheets: T = T1 T2 / (1 - R1 R2)
};
// R of a sheet of transmittance T whose two faces reflect r each (polyester, n = 1.64: r = 0.0588),
//   T = (1-r)^2 t / (1 - r^2 t^2),   R = r + (1-r)^2 r t^2 / (1 - r^2 t^2) = r (1 + t T),
// t the internal transmittance. The air between two clear sheets so gives back 1.2 %, between deep
// ones a third of that. Source: Stokes, Proc. R. Soc. 11, 545 (1862).
inline constexpr double kSheetFaceReflectance = 0.0588;
[[nodiscard]] double SheetReflectance(double transmittance);
// At every node. Holds for transmittances in 0..1.
[[nodiscard]] NodeValues StackOf(const NodeValues& first, const NodeValues& second, SheetGap gap);

// S(l) T(l) on the spectrum's own wavelengths.
[[nodiscard]] Spectrum SpectrumBehind(const Spectrum& light, const NodeValues& transmittance);

}  // namespace lightcal
