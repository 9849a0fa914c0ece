// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/photometric_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lightcal/core/numbers_text.h"

namespace lightcal::records {
namespace {

constexpr double kSameAngleDeg = 1e-6;

void WarnOfAxis(const IntensityGrid& grid, std::string_view where, Warnings& warnings) {
  const auto warn = [&](const std::string& what, double pole, double nearest) {
    warnings.push_back({"no_axis", std::string(where),
                        what + " " + ShortestText(nearest) + " degrees, not at " +
                            ShortestText(pole) + ": nothing is given along the axis, and it is " +
                            "taken as dark. Add the angle " + ShortestText(pole) +
                            " with its intensity, most likely that of " + ShortestText(nearest)});
  };
  const double first = grid.vertical_deg.front();
  const double last = grid.vertical_deg.back();
  if (grid.type != GoniometerType::kC) {
    if (first > kSameAngleDeg) warn("vertical angles begin at", 0.0, first);
    if (grid.horizontal_deg.front() > kSameAngleDeg) {
      warn("horizontal angles begin at", 0.0, grid.horizontal_deg.front());
    }
    return;
  }
  if (first > kSameAngleDeg && first < 90.0 - kSameAngleDeg) {
    warn("vertical angles begin at", 0.0, first);
  }
  // Of a lamp that shines upwards alone the middle is at 180.
  if (first >= 90.0 - kSameAngleDeg && last < 180.0 - kSameAngleDeg) {
    warn("vertical angles of a lamp that shines upwards end at", 180.0, last);
  }
}

void WarnOfTurn(const IntensityGrid& grid, std::string_view where, Warnings& warnings) {
  constexpr double kRelative = 0.01;
  constexpr double kOfPeak = 0.002;
  if (grid.type != GoniometerType::kC ||
      std::abs(grid.horizontal_deg.back() - 360.0) > kSameAngleDeg) {
    return;
  }
  const std::size_t count = grid.vertical_deg.size();
  const double* const last = grid.candela.data() + grid.candela.size() - count;
  const double peak = *std::ranges::max_element(grid.candela);
  std::size_t widest = count;
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double apart = std::abs(grid.candela[i] - last[i]);
    const double least = std::max(kRelative * std::max(grid.candela[i], last[i]), kOfPeak * peak);
    if (apart > least && apart > most) {
      most = apart;
      widest = i;
    }
  }
  if (widest == count) return;
  warnings.push_back({"open_turn", std::string(where),
                      "its planes C0 and C360 are one direction but differ, most at " +
                          ShortestText(grid.vertical_deg[widest]) +
                          " degrees: " + RoundedText(grid.candela[widest], 5) + " cd and " +
                          RoundedText(last[widest], 5) +
                          " cd. Each is used on its side; write the right one in both planes"});
}

}  // namespace

void WarnOfGaps(const IntensityGrid& grid, std::string_view where, Warnings& warnings) {
  WarnOfAxis(grid, where, warnings);
  WarnOfTurn(grid, where, warnings);
}

}  // namespace lightcal::records
