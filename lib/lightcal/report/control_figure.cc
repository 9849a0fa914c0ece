// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/control_figure.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kSweepMargin = 0.06;
constexpr double kPercentOf = 100.0;

// One number of a state, and what its label says it is.
struct SweepMark {
  double at = 0.0;
  Uncertain value;
  std::optional<double> promised;
};

std::vector<SweepMark> OutputsOf(const std::vector<ControlSweep::Point>& points, bool dimmer) {
  std::vector<SweepMark> marks;
  for (const ControlSweep::Point& point : points) {
    Uncertain percent = point.relative;
    percent.value *= kPercentOf;
    percent.u95 *= kPercentOf;
    if (percent.low) *percent.low *= kPercentOf;
    if (percent.high) *percent.high *= kPercentOf;
    marks.push_back({point.at, percent, dimmer ? std::optional(point.at) : std::nullopt});
  }
  return marks;
}

std::vector<SweepMark> TemperaturesOf(const std::vector<ControlSweep::Point>& points) {
  std::vector<SweepMark> marks;
  for (const ControlSweep::Point& point : points) {
    if (point.cct_K) marks.push_back({point.at, *point.cct_K, point.promised_cct_K});
  }
  return marks;
}

struct SweepAxes {
  Axis x, y;
};

// Room for all that is drawn; light from 0 on.
SweepAxes AxesOf(const std::vector<SweepMark>& curve, const std::vector<SweepMark>& read,
                 bool from_zero) {
  double least_x = read.front().at;
  double most_x = least_x;
  double least = LowEnd(read.front().value);
  double most = HighEnd(read.front().value);
  for (const auto* marks : {&curve, &read}) {
    for (const SweepMark& mark : *marks) {
      least_x = std::min(least_x, mark.at);
      most_x = std::max(most_x, mark.at);
      least = std::min({least, LowEnd(mark.value), mark.promised.value_or(least)});
      most = std::max({most, HighEnd(mark.value), mark.promised.value_or(most)});
    }
  }
  const double room_x = kSweepMargin * (most_x - least_x);
  const double room = std::max(kSweepMargin * (most - least), 0.005 * most);
  const PlotArea& area = Svg::Area();
  return {{AxisScale::kLinear, least_x - room_x, most_x + room_x, area.left, area.right},
          {AxisScale::kLinear, from_zero ? 0.0 : least - room, most + room, area.bottom, area.top}};
}

void DrawSweep(Svg& svg, const SweepAxes& axes, const std::vector<SweepMark>& curve,
               const std::vector<SweepMark>& read, const std::string& unit) {
  std::vector<PagePoint> line;
  std::vector<PagePoint> band;
  std::vector<PagePoint> lower;
  std::vector<PagePoint> promise;
  for (const SweepMark& mark : curve) {
    const double x = axes.x.At(mark.at);
    line.emplace_back(x, axes.y.At(mark.value.value));
    band.emplace_back(x, axes.y.At(HighEnd(mark.value)));
    lower.emplace_back(x, axes.y.At(LowEnd(mark.value)));
    if (mark.promised) promise.emplace_back(x, axes.y.At(*mark.promised));
  }
  band.insert(band.end(), lower.rbegin(), lower.rend());
  svg.Path("band", band, true);
  if (promise.size() > 1) svg.Path("guide", promise);
  svg.Path("model", line);
  for (const SweepMark& mark : read) {
    const PagePoint at = {axes.x.At(mark.at), axes.y.At(mark.value.value)};
    svg.Line("whisker", {at.first, axes.y.At(LowEnd(mark.value))},
             {at.first, axes.y.At(HighEnd(mark.value))});
    svg.Circle("used", at, 4.5,
               ShortestText(mark.at) + ": " + RoundedText(mark.value.value, 4) + unit);
  }
}

std::string ControlTitle(const std::string& control) {
  if (control == kDimmerControl) return "dimmer's label (%)";
  if (control == kCctControl) return "colour temperature's label (K)";
  return control + "'s label";
}

std::string SweepFigure(const ControlSweep& sweep, const std::vector<SweepMark>& curve,
                        const std::vector<SweepMark>& read, bool light, std::string_view id) {
  if (read.size() < 2 || curve.size() < 2) return "";
  const SweepAxes axes = AxesOf(curve, read, light);
  Svg svg(std::string(id),
          (light ? "Light against " : "Colour temperature against ") + sweep.control,
          "States that were read, the curve between them with its 95 % band, and the label's "
          "promise");
  svg.Axes(axes.x, axes.y, ControlTitle(sweep.control),
           light ? "light (% of the reference state)" : "CCT (K)");
  svg.BeginPlot();
  DrawSweep(svg, axes, curve, read, light ? " %" : " K");
  svg.EndPlot();
  return svg.Finish();
}

}  // namespace

std::string OutputFigure(const ControlSweep& sweep, std::string_view id) {
  const bool dimmer = sweep.control == kDimmerControl;
  return SweepFigure(sweep, OutputsOf(sweep.curve, dimmer), OutputsOf(sweep.read, dimmer), true,
                     id);
}

std::string TemperatureFigure(const ControlSweep& sweep, std::string_view id) {
  return SweepFigure(sweep, TemperaturesOf(sweep.curve), TemperaturesOf(sweep.read), false, id);
}

std::string ControlCaption(const ControlSweep& sweep) {
  return sweep.others.empty() ? "" : "at " + Escaped(sweep.others);
}

}  // namespace lightcal::report
