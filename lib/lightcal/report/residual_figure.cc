// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/report/figures.h"
#include "lightcal/report/readings.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kLeastHalfSpan_percent = 1.0;
constexpr double kHeadroom = 1.15;

Axis DistanceAxis(const std::vector<ResidualRow>& rows) {
  double low = *rows.front().distance_m;
  double high = low;
  for (const ResidualRow& row : rows) {
    low = std::min(low, *row.distance_m);
    high = std::max(high, *row.distance_m);
  }
  const double margin = high > low ? 1.25 : 2.0;
  return {AxisScale::kLog, low / margin, high * margin, Svg::Area().left, Svg::Area().right};
}

// Wide enough for the used readings and their intervals; rejected ones may lie beyond.
Axis PercentAxis(const std::vector<ResidualRow>& rows) {
  double half = kLeastHalfSpan_percent;
  for (const ResidualRow& row : rows) {
    if (!row.used) continue;
    half = std::max(half, 100.0 * (std::abs(row.relative) + kZ95 * row.sigma_relative));
  }
  half *= kHeadroom;
  return {AxisScale::kLinear, -half, half, Svg::Area().bottom, Svg::Area().top};
}

void DrawRejected(Svg& svg, const ResidualRow& row, double x_px, const Axis& y) {
  const double percent = 100.0 * row.relative;
  if (y.Holds(percent)) {
    svg.Cross("rejected", {x_px, y.At(percent)}, 5.0, TooltipOf(row));
    return;
  }
  const double edge = percent > 0.0 ? Svg::Area().top + 12.0 : Svg::Area().bottom - 12.0;
  svg.Cross("rejected", {x_px, edge}, 5.0, TooltipOf(row));
  const bool near_right = x_px > Svg::Area().right - 90.0;
  svg.Text("note", {x_px + (near_right ? -10.0 : 10.0), edge + 4.0}, near_right ? "end" : "start",
           SignedPercent(row.relative) + (percent > 0.0 ? " ↑" : " ↓"));
}

void DrawUsed(Svg& svg, const ResidualRow& row, double x_px, const Axis& y) {
  const double percent = 100.0 * row.relative;
  const double interval = 100.0 * kZ95 * row.sigma_relative;
  svg.Line("whisker", {x_px, y.At(percent - interval)}, {x_px, y.At(percent + interval)});
  svg.Circle("used", {x_px, y.At(percent)}, 4.5, TooltipOf(row));
}

}  // namespace

std::string ResidualFigure(const FittedLight& light, std::string_view id) {
  const auto rows = RowsWithDistance(light);
  if (rows.empty()) return "";
  const Axis x = DistanceAxis(rows);
  const Axis y = PercentAxis(rows);
  Svg svg(std::string(id), "Residuals",
          "How far each reading lies from the model, in percent, against distance");
  svg.Axes(x, y, "distance from the reference point (m)", "measured − model (%)");
  svg.Line("zero", {Svg::Area().left, y.At(0.0)}, {Svg::Area().right, y.At(0.0)});
  svg.BeginPlot();
  for (const ResidualRow& row : rows) {
    const double x_px = x.At(*row.distance_m);
    if (row.used) {
      DrawUsed(svg, row, x_px, y);
    } else {
      DrawRejected(svg, row, x_px, y);
    }
  }
  svg.EndPlot();
  return svg.Finish();
}

}  // namespace lightcal::report
