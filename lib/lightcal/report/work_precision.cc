// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/work_precision.h"

#include <algorithm>
#include <cmath>

#include "lightcal/report/axis.h"
#include "lightcal/report/label_placement.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kLeastError_percent = 1e-4;
constexpr double kMilliseconds = 1e3;
constexpr double kSettingRadius = 3.4, kNamedRadius = 5.5;

double Shown(double error) { return std::max(kLeastError_percent, 100.0 * error); }

Axis TimeAxis(const WorkPrecision& study) {
  double low = study.points.front().low, high = study.points.front().high;
  for (const WorkPoint& point : study.points) {
    low = std::min({low, point.low, point.seconds});
    high = std::max({high, point.high, point.seconds});
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

// One knob's name as it is, a combination's by its first knobs: "solver loose + 2 more".
std::string ShortName(const std::string& name) {
  constexpr std::size_t kFits = 28;
  if (name.size() <= kFits) return name;
  std::size_t end = name.rfind(", ", kFits);
  if (end == std::string::npos) end = std::min(name.find(", "), name.size());
  const auto more = std::count(name.begin() + static_cast<std::ptrdiff_t>(end), name.end(), ',');
  return name.substr(0, end) + (more > 0 ? " + " + std::to_string(more) + " more" : "");
}

class Drawing {
 public:
  Drawing(Svg& svg, const WorkPrecision& study)
      : svg_(svg), study_(study), x_(TimeAxis(study)), y_(ErrorAxis(study)) {
    const PlotArea& area = Svg::Area();
    ground_.area = {area.left + 2.0, area.top + 2.0, area.right - 2.0, area.bottom - 2.0};
    svg_.Axes(x_, y_, "time of one run (ms)", "off the strictest setting (%)");
  }

  void Limits() {
    const double tolerance = y_.At(Shown(study_.tolerance));
    Limit("tolerance", study_.tolerance, "second", true);
    if (study_.allowed && *study_.allowed < study_.tolerance) {
      const bool apart = y_.At(Shown(*study_.allowed)) - tolerance > kNoteLine + 2.0;
      Limit("a third of your u", *study_.allowed, "guide", apart);
    }
  }

  void Best() {
    std::vector<PagePoint> steps;
    for (const WorkPoint& point : study_.best) {
      const PagePoint at = At(point);
      if (!steps.empty()) steps.emplace_back(at.first, steps.back().second);
      steps.push_back(at);
    }
    if (steps.size() < 2) return;
    svg_.Path("model", steps);
    ground_.lines.push_back(std::move(steps));
  }

  void Points() {
    for (const WorkPoint& point : study_.points) {
      if (point.kind == WorkPointKind::kSetting) Point(point, "setting", kSettingRadius);
    }
    for (const WorkPoint& point : study_.points) {
      if (point.kind == WorkPointKind::kUsual) Point(point, "used", kNamedRadius);
      if (point.kind == WorkPointKind::kRecommended) Point(point, "chosen", kNamedRadius);
    }
  }

  // After everything else: names stand where nothing does.
  void Names() {
    std::vector<LabelWish> wishes;
    for (const WorkPoint& point : study_.points) {
      if (point.kind == WorkPointKind::kUsual) wishes.push_back({At(point), "as usual"});
      if (point.kind == WorkPointKind::kRecommended) wishes.push_back({At(point), "recommended"});
    }
    for (const WorkPoint& point : study_.best) {
      if (point.kind == WorkPointKind::kSetting) {
        wishes.push_back({At(point), ShortName(point.name)});
      }
    }
    for (const WorkPoint& point : study_.points) {
      if (point.kind != WorkPointKind::kSetting) continue;
      std::string name = ShortName(point.name);
      const auto same = [&](const LabelWish& wish) { return wish.text == name; };
      if (std::ranges::none_of(wishes, same)) {
        wishes.push_back({At(point), std::move(name), false});
      }
    }
    const std::vector<PlacedLabel> labels = PlaceLabels(wishes, ground_);
    for (const PlacedLabel& label : labels) {
      if (label.leader) svg_.Line("leader", wishes[label.wish].point, *label.leader);
    }
    for (const LimitName& limit : limits_) {
      svg_.Text("note halo", limit.at, limit.ends_there ? "end" : "start", limit.text);
    }
    for (const PlacedLabel& label : labels) {
      svg_.Text("note halo", label.text_at, "start", wishes[label.wish].text);
    }
  }

 private:
  struct LimitName {
    std::string text;
    PagePoint at;
    bool ends_there = true;
  };

  [[nodiscard]] PagePoint At(const WorkPoint& point) const {
    return {x_.At(kMilliseconds * point.seconds), y_.At(Shown(point.error))};
  }

  void Limit(std::string_view name, double relative, std::string_view css, bool at_right) {
    const PlotArea& area = Svg::Area();
    const double at = y_.At(Shown(relative));
    svg_.Line(css, {area.left, at}, {area.right, at});
    ground_.lines.push_back({{area.left, at}, {area.right, at}});
    const std::string text =
        std::string(name) + " " + Figure(std::round(1e5 * relative) / 1e3) + " %";
    const double width = NoteWidth(text);
    const double left = at_right ? area.right - 4.0 - width : area.left + 4.0;
    limits_.push_back({text, {at_right ? left + width : left, at - 5.0}, at_right});
    ground_.taken.push_back({left, at - kNoteLine, left + width, at - 1.0});
  }

  void Point(const WorkPoint& point, std::string_view css, double radius) {
    const auto [x, y] = At(point);
    const double low = x_.At(kMilliseconds * point.low), high = x_.At(kMilliseconds * point.high);
    svg_.Line("whisker", {low, y}, {high, y});
    svg_.Circle(css, {x, y}, radius, TooltipOf(point));
    ground_.taken.push_back({x - radius, y - radius, x + radius, y + radius});
    ground_.lines.push_back({{low, y}, {high, y}});
  }

  Svg& svg_;
  const WorkPrecision& study_;
  Axis x_, y_;
  LabelGround ground_;
  std::vector<LimitName> limits_;
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
  drawing.Names();
  svg.EndPlot();
  return StandaloneSvg(svg.Finish(), "svg .leader { stroke: var(--soft); stroke-width: 1; }\n");
}

}  // namespace lightcal::report
