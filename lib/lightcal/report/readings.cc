// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/readings.h"

#include <algorithm>

#include "lightcal/core/numbers_text.h"
#include "lightcal/report/text.h"

namespace lightcal::report {

std::vector<ResidualRow> RowsWithDistance(const FittedLight& light) {
  std::vector<ResidualRow> rows;
  for (const ResidualRow& row : light.residuals) {
    if (row.distance_m && *row.distance_m > 0.0) rows.push_back(row);
  }
  return rows;
}

double FacingLux(const ResidualRow& row) {
  if (!row.facing_lx || !(row.predicted_lx > 0.0)) return row.measured_lx;
  return row.measured_lx * *row.facing_lx / row.predicted_lx;
}

bool SomeTurned(const std::vector<ResidualRow>& rows) {
  return std::ranges::any_of(rows,
                             [](const ResidualRow& row) { return row.facing_lx.has_value(); });
}

bool HoldWalls(const std::vector<ResidualRow>& rows) {
  return std::ranges::any_of(rows, [](const ResidualRow& row) { return row.walls_lx.has_value(); });
}

std::string TooltipOf(const ResidualRow& row) {
  std::string text = "reading " + std::to_string(row.index) + ": ";
  if (row.distance_m) text += Figure(*row.distance_m) + " m, ";
  text += RoundedText(row.measured_lx, 5) + " lx";
  if (row.facing_lx) text += " (facing the lamp " + RoundedText(FacingLux(row), 4) + " lx)";
  return text + ", " + SignedPercent(row.relative) + (row.used ? "" : ", rejected");
}

}  // namespace lightcal::report
