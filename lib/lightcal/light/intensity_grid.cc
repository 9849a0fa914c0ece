// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/intensity_grid.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

// Beyond any lamp; keeps sums finite.
constexpr double kMostCandela = 1e18;

std::string CheckAngles(const std::vector<double>& angles, double low, double high,
                        const std::string& what) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] >= low - kAngleSlack_deg && angles[i] <= high + kAngleSlack_deg)) {
      return what + " " + std::to_string(i + 1) + " lies outside " + ShortestText(low) + " to " +
             ShortestText(high) + " degrees";
    }
    if (i > 0 && !(angles[i] > angles[i - 1])) {
      return what + "s must increase: " + ShortestText(angles[i]) + " after " +
             ShortestText(angles[i - 1]);
    }
  }
  return {};
}

std::string CheckCandela(const IntensityGrid& grid) {
  const std::size_t wanted = grid.horizontal_deg.size() * grid.vertical_deg.size();
  if (grid.candela.size() != wanted) {
    return std::to_string(grid.candela.size()) + " intensities where " + std::to_string(wanted) +
           " are needed";
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < wanted; ++i) {
    if (!(grid.candela[i] >= 0.0 && grid.candela[i] <= kMostCandela)) {
      const std::size_t of_plane = grid.vertical_deg.size();
      return "towards " + ShortestText(grid.horizontal_deg[i / of_plane]) +
             " degrees horizontal, " + ShortestText(grid.vertical_deg[i % of_plane]) +
             " vertical, " + ShortestText(grid.candela[i]) +
             " is no lamp's number of candela, zero or more";
    }
    largest = std::max(largest, grid.candela[i]);
  }
  return largest > 0.0 ? std::string() : "no direction has any light";
}

// Planes that a full turn needs but the file leaves out: the one at 360.
bool TurnCloses(const std::vector<double>& c) {
  const double last_gap = c.back() - c[c.size() - 2];
  return SameAngle(c.back(), 360.0) || 360.0 - c.back() <= last_gap + kAngleSlack_deg;
}

Result<TableSymmetry> SymmetryOfC(const std::vector<double>& c, std::string_view where) {
  if (c.size() == 1) return TableSymmetry::kAxial;
  if (SameAngle(c.front(), 0.0) && SameAngle(c.back(), 90.0)) return TableSymmetry::kQuadrant;
  if (SameAngle(c.front(), 0.0) && SameAngle(c.back(), 180.0)) return TableSymmetry::kBilateral;
  if (SameAngle(c.front(), 90.0) && SameAngle(c.back(), 270.0)) return TableSymmetry::kBilateral90;
  if (SameAngle(c.front(), 0.0) && TurnCloses(c)) return TableSymmetry::kNone;
  return Refused("bad_table", std::string(where),
                 "C planes from " + ShortestText(c.front()) + " to " + ShortestText(c.back()) +
                     " degrees make no whole lamp; a file holds 0, 0 to 90, 0 to 180, 90 to 270 or "
                     "0 to 360");
}

TableSymmetry SymmetryOfAB(const IntensityGrid& grid) {
  const bool mirror_h = SameAngle(grid.horizontal_deg.front(), 0.0);
  const bool mirror_v = SameAngle(grid.vertical_deg.front(), 0.0);
  if (mirror_h && mirror_v) return TableSymmetry::kQuadrant;
  if (mirror_h) return TableSymmetry::kBilateral;
  return mirror_v ? TableSymmetry::kBilateral90 : TableSymmetry::kNone;
}

}  // namespace

Result<TableSymmetry> SymmetryOfGrid(const IntensityGrid& grid, std::string_view where) {
  const bool is_c = grid.type == GoniometerType::kC;
  const std::size_t least_planes = is_c ? 1 : 2;
  std::string fault;
  if (grid.vertical_deg.size() < 2 || grid.horizontal_deg.size() < least_planes) {
    fault = "too few angles: two vertical ones are needed, and of types A and B two horizontal";
  }
  if (fault.empty()) {
    fault =
        CheckAngles(grid.vertical_deg, is_c ? 0.0 : -90.0, is_c ? 180.0 : 90.0, "vertical angle");
  }
  if (fault.empty()) {
    fault = CheckAngles(grid.horizontal_deg, is_c ? 0.0 : -90.0, is_c ? 360.0 : 90.0,
                        "horizontal angle");
  }
  if (fault.empty()) fault = CheckCandela(grid);
  if (!fault.empty()) return Refused("bad_table", std::string(where), fault);
  if (!is_c) return SymmetryOfAB(grid);
  return SymmetryOfC(grid.horizontal_deg, where);
}

}  // namespace lightcal
