// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/minutes_figure.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/report/label_placement.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kStepRadius = 4.0;

double PercentOf(double u95_relative) { return 100.0 * u95_relative; }

// "read 1.41 m", "card 0.5 m", "lamp off".
std::string StepName(const PlannedReading& reading) {
  if (reading.action == PlannedAction::kLampOff) return "lamp off";
  const std::string what = reading.action == PlannedAction::kShadowCard ? "card" : "read";
  return reading.distance ? what + " " + RoundedText(reading.distance->value(), 3) + " m" : what;
}

Axis MinutesAxis(std::span<const MinutesLadder> ladders) {
  double high = 0.0;
  for (const MinutesLadder& ladder : ladders) {
    if (!ladder.steps.empty()) high = std::max(high, ladder.steps.back().total_minutes);
  }
  return {AxisScale::kLinear, 0.0, std::max(1.0, 1.12 * high), Svg::Area().left, Svg::Area().right};
}

Axis UncertaintyAxis(std::span<const MinutesLadder> ladders) {
  double low = 1e6;
  double high = 0.0;
  const auto add = [&](double u95_relative) {
    if (!(u95_relative > 0.0)) return;
    low = std::min(low, PercentOf(u95_relative));
    high = std::max(high, PercentOf(u95_relative));
  };
  for (const MinutesLadder& ladder : ladders) {
    if (ladder.steps.empty()) continue;
    add(ladder.u95_relative.value_or(0.0));
    add(ladder.meter_u95_relative);
    for (const LadderStep& step : ladder.steps) add(step.reading.u95_relative);
  }
  return {AxisScale::kLog, 0.75 * low, 1.6 * high, Svg::Area().bottom, Svg::Area().top};
}

class Staircase {
 public:
  Staircase(Svg& svg, std::span<const MinutesLadder> ladders)
      : svg_(svg), ladders_(ladders), x_(MinutesAxis(ladders)), y_(UncertaintyAxis(ladders)) {
    const PlotArea& area = Svg::Area();
    ground_.area = {area.left + 2.0, area.top + 2.0, area.right - 2.0, area.bottom - 2.0};
    svg_.Axes(x_, y_, "minutes of measuring", "95 % uncertainty (± %)");
  }

  void Meters() {
    std::vector<double> drawn;
    for (const MinutesLadder& ladder : ladders_) {
      const double u95 = ladder.meter_u95_relative;
      if (!(u95 > 0.0) || ladder.steps.empty() || std::ranges::count(drawn, u95) > 0) continue;
      drawn.push_back(u95);
      const PlotArea& area = Svg::Area();
      const double at = y_.At(PercentOf(u95));
      svg_.Line("second", {area.left, at}, {area.right, at});
      ground_.lines.push_back({{area.left, at}, {area.right, at}});
      const std::string text = "the meter itself " + RelativeText(IntervalOfFactor(u95));
      const double right = area.left + 4.0 + NoteWidth(text);
      notes_.push_back({{area.left + 4.0, at + 14.0}, text});
      ground_.taken.push_back({area.left + 4.0, at + 1.0, right, at + 1.0 + kNoteLine});
    }
  }

  void Stairs() {
    for (const MinutesLadder& ladder : ladders_) {
      std::vector<PagePoint> line;
      if (ladder.u95_relative) line.push_back({x_.At(0.0), y_.At(PercentOf(*ladder.u95_relative))});
      for (const LadderStep& step : ladder.steps) {
        const PagePoint at = At(step);
        if (!line.empty()) line.emplace_back(at.first, line.back().second);
        line.push_back(at);
      }
      if (line.size() > 1) svg_.Path("model", line);
      ground_.lines.push_back(std::move(line));
    }
  }

  void Steps() {
    for (const MinutesLadder& ladder : ladders_) {
      for (const LadderStep& step : ladder.steps) {
        const auto [x, y] = At(step);
        svg_.Circle(
            "used", {x, y}, kStepRadius,
            Figure(step.total_minutes) + " min: " + step.say + ", " +
                RelativeText(IntervalOfWidths(step.reading.u95_relative, step.reading.u95_stops)));
        ground_.taken.push_back(
            {x - kStepRadius, y - kStepRadius, x + kStepRadius, y + kStepRadius});
      }
    }
  }

  // After everything else: names stand where nothing does.
  void Names() {
    std::vector<LabelWish> wishes;
    const auto has_steps = [](const MinutesLadder& ladder) { return !ladder.steps.empty(); };
    const bool several = std::ranges::count_if(ladders_, has_steps) > 1;
    for (const MinutesLadder& ladder : ladders_) {
      if (ladder.steps.empty()) continue;
      if (several) wishes.push_back({At(ladder.steps.back()), ladder.light});
      std::string_view before;
      for (const LadderStep& step : ladder.steps) {  // the same once more needs no name
        if (!several && step.say != before) {
          wishes.push_back({At(step), StepName(step.reading)});
        }
        before = step.say;
      }
    }
    const std::vector<PlacedLabel> labels = PlaceLabels(wishes, ground_);
    for (const PlacedLabel& label : labels) {
      if (label.leader) svg_.Line("leader", wishes[label.wish].point, *label.leader);
    }
    for (const Note& note : notes_) svg_.Text("note halo", note.at, "start", note.text);
    for (const PlacedLabel& label : labels) {
      svg_.Text("note halo", label.text_at, "start", wishes[label.wish].text);
    }
  }

 private:
  struct Note {
    PagePoint at;
    std::string text;
  };

  [[nodiscard]] PagePoint At(const LadderStep& step) const {
    return {x_.At(step.total_minutes), y_.At(PercentOf(step.reading.u95_relative))};
  }

  Svg& svg_;
  std::span<const MinutesLadder> ladders_;
  Axis x_, y_;
  LabelGround ground_;
  std::vector<Note> notes_;
};

}  // namespace

std::string MinutesFigure(std::span<const MinutesLadder> ladders, std::string_view id) {
  const auto none = [](const MinutesLadder& ladder) { return ladder.steps.empty(); };
  if (std::ranges::all_of(ladders, none)) return "";
  Svg svg(std::string(id), "Accuracy against minutes",
          "The uncertainty predicted after each further reading against the minutes it takes");
  Staircase drawing(svg, ladders);
  svg.BeginPlot();
  drawing.Meters();
  drawing.Stairs();
  drawing.Steps();
  drawing.Names();
  svg.EndPlot();
  return svg.Finish();
}

std::string MinutesPlot(std::span<const MinutesLadder> ladders) {
  std::string figure = MinutesFigure(ladders, "minutes");
  if (figure.empty()) return "";
  return StandaloneSvg(WithCaption(std::move(figure), MinutesCaption(ladders)));
}

PlotCaption MinutesCaption(std::span<const MinutesLadder> ladders) {
  PlotCaption caption{{DotKey("after a further reading or card, as foretold")}, ""};
  const auto knows_meter = [](const MinutesLadder& one) { return one.meter_u95_relative > 0.0; };
  if (std::ranges::any_of(ladders, knows_meter)) {
    caption.keys.push_back(LineKey("second", "what the meter's own calibration leaves"));
  }
  return caption;
}

}  // namespace lightcal::report
