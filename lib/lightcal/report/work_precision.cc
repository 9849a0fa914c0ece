// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/work_precision.h"

#include <algorithm>
#include <cmath>

#include "lightcal/report/axis.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kLeastError_percent = 1e-4;
constexpr double kMilliseconds = 1e3;

double Shown(double error) { return std::max(kLeastError_percent, 100.0 * error); }

Axis TimeAxis(const WorkPrecision& study) {
  double low = study.points.front().low, high = study.points.front().high;
  for (const WorkPoint& point : study.points) {
    low = std::min(low, point.low);
    high = std::max(high, point.high);
  }
  low = std::max(low, 1e-7);
  const double margin = std::max(1.15, std::pow(std::max(1.0, high / low), 0.06));
  return {AxisScale::kLog, kMilliseconds * low / margin, kMilliseconds * high * margin,
          Svg::Area().left, Svg::Area().right};
}

Axis ErrorAxis(const WorkPrecision& study) {
  double high = 100.0 * study.tolerance;
  for (const WorkPoint& point : study.points) high = std::max(high, Shown(point.error));
  return {AxisScale::kLog, 0.6 * kLeastError_percent, 3.0 * high, Svg::Area().bottom,
          Svg::Area().top};
}

std::string TooltipOf(const WorkPoint& point) {
  return point.name + ": " + Figure(kMilliseconds * point.seconds) + " ms, " +
         (point.error > 0.0 ? Figure(100.0 * point.error) + " %" : "no change");
}

class Drawing {
 public:
  Drawing(Svg& svg, const WorkPrecision& study)
      : svg_(svg), study_(study), x_(TimeAxis(study)), y_(ErrorAxis(study)) {
    svg_.Axes(x_, y_, "time of one run (ms)", "off the strictest setting (%)");
  }

  void Limits() {
    Limit("tolerance", study_.tolerance, "second");
    if (study_.allowed && *study_.allowed < study_.tolerance) {
      Limit("a third of your u", *study_.allowed, "guide");
    }
  }

  void Best() {
    std::vector<PagePoint> steps;
    for (const WorkPoint& point : study_.best) {
      const PagePoint at = At(point);
      if (!steps.empty()) steps.emplace_back(at.first, steps.back().second);
      steps.push_back(at);
    }
    if (steps.size() > 1) svg_.Path("model", steps);
    for (const WorkPoint& point : study_.best) NameShortly(point);
  }

  void Points() {
    for (const WorkPoint& point : study_.points) {
      if (point.kind == WorkPointKind::kSetting) Point(point, "setting", 3.4);
    }
    for (const WorkPoint& point : study_.points) {
      if (point.kind == WorkPointKind::kUsual) Named(point, "used", "as usual", -12.0);
      if (point.kind == WorkPointKind::kRecommended) Named(point, "chosen", "recommended", 18.0);
    }
  }

 private:
  [[nodiscard]] PagePoint At(const WorkPoint& point) const {
    return {x_.At(kMilliseconds * point.seconds), y_.At(Shown(point.error))};
  }

  void Limit(std::string_view name, double relative, std::string_view css) {
    const double at = y_.At(Shown(relative));
    svg_.Line(css, {Svg::Area().left, at}, {Svg::Area().right, at});
    svg_.Text("note", {Svg::Area().right - 4.0, at - 5.0}, "end",
              std::string(name) + " " + Figure(std::round(1e5 * relative) / 1e3) + " %");
  }

  void Point(const WorkPoint& point, std::string_view css, double radius) {
    const PagePoint at = At(point);
    svg_.Line("whisker", {x_.At(kMilliseconds * point.low), at.second},
              {x_.At(kMilliseconds * point.high), at.second});
    svg_.Circle(css, at, radius, TooltipOf(point));
  }

  // One knob's name fits beside its point; a combination's does not.
  void NameShortly(const WorkPoint& point) {
    constexpr std::size_t kFits = 28;
    if (point.kind != WorkPointKind::kSetting || point.name.size() > kFits) return;
    const PagePoint at = At(point);
    const bool right = at.first > 0.6 * Svg::Area().right;
    svg_.Text("note", {at.first + (right ? -8.0 : 8.0), at.second + 16.0}, right ? "end" : "start",
              point.name);
  }

  void Named(const WorkPoint& point, std::string_view css, std::string_view name, double down) {
    Point(point, css, 5.5);
    const PagePoint at = At(point);
    const bool right = at.first > 0.5 * (Svg::Area().left + Svg::Area().right);
    svg_.Text("note", {at.first, at.second + down}, right ? "end" : "start", name);
  }

  Svg& svg_;
  const WorkPrecision& study_;
  Axis x_, y_;
};

}  // namespace

std::string WorkPrecisionPlot(const WorkPrecision& study) {
  Svg svg("work-precision", study.title,
          "How far each setting lies from the strictest one against how long it takes");
  Drawing drawing(svg, study);
  drawing.Limits();
  svg.BeginPlot();
  drawing.Best();
  drawing.Points();
  svg.EndPlot();
  return StandaloneSvg(svg.Finish());
}

}  // namespace lightcal::report
