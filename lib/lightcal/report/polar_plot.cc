// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/polar_plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/report/axis.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

using std::numbers::pi;

constexpr int kSteps = 720;  // of a whole plane
constexpr double kSpokeDeg = 15.0;

struct PolarLayout {
  PagePoint centre;
  double radius = 0.0;  // of the outermost ring
  bool whole = false;   // both hemispheres
  Axis rings;
  double ring_gap = 34.0;

  // out: angle from straight down, positive to the right.
  [[nodiscard]] PagePoint At(double candela, double out) const {
    const double r = rings.At(candela);
    return {centre.first + r * std::sin(out), centre.second + r * std::cos(out)};
  }
};

double CandelaAt(const IntensityTable& table, double plane, double out) {
  const double c = out < 0.0 ? plane + pi : plane;
  return table.At(Radians(c), Radians(std::abs(out))).value();
}

double LargestAbove(const IntensityTable& table) {
  double largest = 0.0;
  for (const double plane : {0.0, 0.5 * pi}) {
    for (int i = kSteps / 4 + 2; i <= kSteps / 2; ++i) {
      const double out = 2.0 * pi * i / kSteps;
      largest = std::max({largest, CandelaAt(table, plane, out), CandelaAt(table, plane, -out)});
    }
  }
  return largest;
}

PolarLayout LayoutOf(const IntensityTable& table) {
  PolarLayout layout;
  constexpr double kVisible = 0.005;  // of the peak
  layout.whole = LargestAbove(table) > kVisible * table.peak().intensity.value();
  layout.radius = layout.whole ? 128.0 : 192.0;
  layout.centre = {kFigureWidth / 2.0, layout.whole ? 180.0 : 52.0};
  layout.rings = {AxisScale::kLinear, 0.0, table.peak().intensity.value(), 0.0,
                  layout.whole ? 122.0 : 184.0};
  // Their numbers stand side by side.
  constexpr double kCharacter = 9.0, kSpace = 8.0;
  const auto length = static_cast<double>(Figure(std::round(layout.rings.high)).size());
  layout.ring_gap = std::max(layout.ring_gap, kCharacter * length + kSpace);
  return layout;
}

void DrawGrid(Svg& svg, const PolarLayout& layout) {
  const double most = layout.whole ? pi : 0.5 * pi;
  const auto arc = [&](double candela) {
    std::vector<PagePoint> points;
    for (int i = -90; i <= 90; ++i) points.push_back(layout.At(candela, most * i / 90.0));
    return points;
  };
  for (const double candela : TicksOf(layout.rings, layout.ring_gap)) {
    if (candela > 0.0) svg.Path("ring", arc(candela));
  }
  const double edge = layout.rings.high * layout.radius / layout.rings.to_px;
  for (double deg = 0.0; deg <= DegreesFromRadians(Radians(most)) + 1e-9; deg += kSpokeDeg) {
    const double out = RadiansFromDegrees(deg).value();
    for (const double side : {1.0, -1.0}) {
      svg.Line("grid", layout.centre, layout.At(edge, side * out));
      const bool labelled = std::fmod(deg, 30.0) == 0.0 && deg > 0.0 && (deg < 180.0 || side > 0.0);
      if (!labelled) continue;
      PagePoint at = layout.At(edge * 1.05, side * out);
      at.second += 4.0;
      svg.Text("tick", at, deg == 180.0 ? "middle" : (side > 0.0 ? "start" : "end"),
               Figure(deg) + "°");
    }
  }
}

// Along the horizon, where few lamps shine.
void DrawRingLabels(Svg& svg, const PolarLayout& layout) {
  for (const double candela : TicksOf(layout.rings, layout.ring_gap)) {
    if (!(candela > 0.0)) continue;
    const PagePoint at = layout.At(candela, 0.5 * pi);
    svg.Text("tick halo", {at.first, at.second - 6.0}, "middle", Figure(candela));
  }
}

void DrawPlane(Svg& svg, const PolarLayout& layout, const IntensityTable& table, double plane,
               std::string_view css, bool filled = false) {
  std::vector<PagePoint> points;
  const double most = layout.whole ? pi : 0.5 * pi;
  for (int i = -kSteps / 2; i <= kSteps / 2; ++i) {
    const double out = most * 2.0 * i / kSteps;
    points.push_back(layout.At(CandelaAt(table, plane, out), out));
  }
  if (filled) svg.Path("band", points, true);
  svg.Path(css, points);
}

void DrawKey(Svg& svg, const IntensityTable& table, bool two_planes) {
  const auto row = [&](double y, std::string_view css, std::string_view name) {
    svg.Line(css, {14.0, y - 4.0}, {42.0, y - 4.0});
    svg.Text("note", {48.0, y}, "start", name);
  };
  const double top = kFigureHeight - 26.0;
  row(top, "model", two_planes ? "C0 – C180" : "all planes");
  if (two_planes) row(top + 18.0, "second", "C90 – C270");
  const LobeWidths beam = LobeWidthsAt(table, 0.5);
  const auto right = [&](double y, const std::string& text) {
    svg.Text("note", {kFigureWidth - 14.0, y}, "end", text);
  };
  right(top, Figure(std::round(table.Flux().value() * 10.0) / 10.0) + " lm, peak " +
                 Fixed(table.peak().intensity.value(), 1) + " cd");
  right(top + 18.0, "beam " + Fixed(DegreesFromRadians(beam.mean), 1) + "°, field " +
                        Fixed(DegreesFromRadians(LobeWidthsAt(table, 0.1).mean), 1) + "°" +
                        (beam.beside_axis ? " about the peak" : ""));
}

// heading: drawn above the diagram; "" where the page has one.
std::string Draw(const IntensityTable& table, std::string_view heading, std::string_view id) {
  Svg svg(std::string(id), heading.empty() ? "Intensity by direction" : heading,
          "Polar diagram of luminous intensity in candela, written by lightcal");
  const PolarLayout layout = LayoutOf(table);
  const bool two_planes = table.symmetry() != TableSymmetry::kAxial;
  DrawGrid(svg, layout);
  if (two_planes) DrawPlane(svg, layout, table, 0.5 * pi, "second");
  DrawPlane(svg, layout, table, 0.0, "model", true);
  DrawRingLabels(svg, layout);
  if (!heading.empty()) svg.Text("", {14.0, 18.0}, "start", heading);
  svg.Text("note", {kFigureWidth - 14.0, 18.0}, "end", "cd");
  DrawKey(svg, table, two_planes);
  return svg.Finish();
}

}  // namespace

std::string PolarFigure(const FittedLight& light, std::string_view id) {
  return light.distribution ? Draw(light.distribution->table, "", id) : "";
}

std::string PolarPlot(const IntensityTable& table, std::string_view title) {
  return StandaloneSvg(Draw(table, title, "polar"));
}

}  // namespace lightcal::report
