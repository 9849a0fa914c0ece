// SPDX-License-Identifier: Apache-2.0
// What a photometric file stores of a distribution: its planes, angles and candela.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// The lamp's own frame, right-handed: it hangs with its nadir along -Z, its C0 half-plane holds +X,
// its C90 half-plane +Y, so that C turns counterclockwise seen from above. Vertical and horizontal
// angles as files name them:
//   type C   gamma from nadir, C about it      x = sin g cos C, y = sin g sin C,  z = -cos g
//   type B   planes of V about the width, C90  x = cos H sin V, y = -sin H,       z = -cos H cos V
//   type A   planes of H about the length, C0  x = sin V,       y = -cos V sin H, z = -cos V cos H
// The lamp's aim is its nadir, which is (0, 0) of types A and B: near it, both name a direction
// alike, V towards C0 and H towards C270 (upwards and to the right where C0 points up).
// Source: IESNA LM-63-2002, 3 (H turns clockwise in A and B); I. Ashdown's reading of LM-63 for the
// axes (poles: the luminaire's length in A, its width in B; C0 along the length), as CIE 121 and EN
// 13032-1 lay A, B and C planes. Where C0 lies on the lamp, files tell loosely.
enum class GoniometerType : std::uint8_t { kC, kB, kA };
inline constexpr std::array<std::string_view, 3> kGoniometerTypeWords = {"C", "B", "A"};

// Which mirror images of the stored planes make the whole.
enum class TableSymmetry : std::uint8_t {
  kNone,
  kAxial,        // one C plane
  kBilateral,    // C0 to C180: mirrored in the plane C0-C180. Types A, B: H from 0, mirrored in H
  kBilateral90,  // C90 to C270: mirrored in the plane C90-C270. Types A, B: V from 0
  kQuadrant,     // C0 to C90, or both of the above
};
inline constexpr std::array<std::string_view, 5> kTableSymmetryWords = {
    "none", "axial", "bilateral", "bilateral_90", "quadrant"};

// What a file stores: angles in degrees as they stand in it, and candela, all vertical angles of
// the first horizontal angle, then of the next.
//   type C     vertical = gamma within 0..180; horizontal = C: {0} alone (axial), 0..90, 0..180,
//              90..270, or a full turn from 0, whose last plane (360) may be left out
//   types A, B vertical = V and horizontal = H within -90..90; first 0 stands for its mirror image
struct IntensityGrid {
  GoniometerType type = GoniometerType::kC;
  std::vector<double> horizontal_deg;
  std::vector<double> vertical_deg;
  std::vector<double> candela;  // horizontal_deg.size() * vertical_deg.size()
};

// Files write degrees to a thousandth at most.
inline constexpr double kAngleSlack_deg = 1e-6;
[[nodiscard]] inline bool SameAngle(double a_deg, double b_deg) {
  return std::abs(a_deg - b_deg) <= kAngleSlack_deg;
}

// What the planes leave to mirror images. Refused: bad_table (see IntensityTable::Make).
[[nodiscard]] Result<TableSymmetry> SymmetryOfGrid(const IntensityGrid& grid,
                                                   std::string_view where);

}  // namespace lightcal
