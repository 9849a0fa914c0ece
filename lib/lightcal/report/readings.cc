// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/readings.h"

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

std::string TooltipOf(const ResidualRow& row) {
  std::string text = "reading " + std::to_string(row.index) + ": ";
  if (row.distance_m) text += Figure(*row.distance_m) + " m, ";
  return text + RoundedText(row.measured_lx, 5) + " lx, " + SignedPercent(row.relative) +
         (row.used ? "" : ", rejected");
}

}  // namespace lightcal::report
