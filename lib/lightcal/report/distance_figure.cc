// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lightcal/records/light_curve.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/readings.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr int kCurveSteps = 96;

struct Range {
  double low, high;
  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

double Shown(const LightCurve& curve, const ResidualRow& row) {
  return curve.LuxAt(*row.distance_m) * (1.0 + row.relative);
}

// The readings' distances with room to both sides, never at or behind the effective source.
Axis DistanceAxis(const std::vector<ResidualRow>& rows, const LightCurve& curve) {
  Range range{*rows.front().distance_m, *rows.front().distance_m};
  for (const ResidualRow& row : rows) range.Add(*row.distance_m);
  const double margin = range.high > range.low ? 1.25 : 2.0;
  const double nearest = std::max(curve.nearest_m(), 0.0);
  const double low = std::max(range.low / margin, nearest + (range.low - nearest) / margin);
  return {AxisScale::kLog, low, range.high * margin, Svg::Area().left, Svg::Area().right};
}

Axis IlluminanceAxis(const std::vector<ResidualRow>& rows, const LightCurve& curve, const Axis& x) {
  Range range{curve.LuxAt(x.high), curve.LuxAt(x.low)};
  for (const ResidualRow& row : rows) {
    const double shown = Shown(curve, row);
    if (shown > 0.0) range.Add(shown);
  }
  return {AxisScale::kLog, range.low / 1.3, range.high * 1.3, Svg::Area().bottom, Svg::Area().top};
}

void DrawModel(Svg& svg, const LightCurve& curve, const Axis& x, const Axis& y) {
  std::vector<PagePoint> line;
  std::vector<PagePoint> upper;
  std::vector<PagePoint> lower;
  for (int i = 0; i <= kCurveSteps; ++i) {
    const double d = x.low * std::pow(x.high / x.low, static_cast<double>(i) / kCurveSteps);
    const double lux = curve.LuxAt(d);
    line.emplace_back(x.At(d), y.At(lux));
    if (const auto sd = curve.SdOfLogAt(d)) {
      const double factor = std::exp(std::min(kZ95 * *sd, 10.0));
      upper.emplace_back(x.At(d), y.At(lux * factor));
      lower.emplace_back(x.At(d), y.At(lux / factor));
    }
  }
  if (!upper.empty()) {
    upper.insert(upper.end(), lower.rbegin(), lower.rend());
    svg.Path("band", upper, true);
  }
  svg.Path("model", line);
}

void DrawReading(Svg& svg, const ResidualRow& row, PagePoint at, const Axis& y, double lux) {
  if (!row.used) {
    svg.Cross("rejected", at, 5.0, TooltipOf(row));
    return;
  }
  const double factor = std::exp(kZ95 * row.sigma_relative);
  svg.Line("whisker", {at.first, y.At(lux / factor)}, {at.first, y.At(lux * factor)});
  svg.Circle("used", at, 4.5, TooltipOf(row));
}

}  // namespace

std::string DistanceFigure(const FittedLight& light, std::string_view id) {
  const auto curve = LightCurve::Of(light);
  const auto rows = RowsWithDistance(light);
  if (!curve || rows.empty()) return "";
  const Axis x = DistanceAxis(rows, *curve);
  const Axis y = IlluminanceAxis(rows, *curve, x);
  const bool walls = HoldWalls(rows);
  Svg svg(std::string(id), "Illuminance against distance",
          std::string(walls ? "Readings less the walls' light" : "Readings") +
              ", the fitted lamp and its 95 % band, both axes logarithmic");
  const std::string facing = SomeTurned(rows) ? " facing it" : "";
  svg.Axes(x, y, "distance from the reference point (m)",
           walls              ? "illuminance by the lamp alone" + facing + " (lx)"
           : SomeTurned(rows) ? "illuminance facing the lamp (lx)"
                              : "illuminance (lx)");
  svg.BeginPlot();
  DrawModel(svg, *curve, x, y);
  for (const ResidualRow& row : rows) {
    const double lux = Shown(*curve, row);
    if (lux > 0.0) DrawReading(svg, row, {x.At(*row.distance_m), y.At(lux)}, y, lux);
  }
  svg.EndPlot();
  return svg.Finish();
}

}  // namespace lightcal::report
