// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/gate_figure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/light/gate_ladder.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kWidth = 860.0;
constexpr double kRow = 30.0;
constexpr double kBarsTop = 74.0;
constexpr double kBarsLeft = 222.0;
constexpr double kFirstRight = 520.0;
constexpr double kSecondLeft = 566.0;
constexpr double kSecondRight = 826.0;
constexpr double kLeastError = 1e-4;  // what lies below stands at the edge
constexpr double kMost = 1.0;

struct Row {
  std::string name;
  bool own = false;  // of the session, not of the ladder
  double all_ns = 0.0, gate_ns = 0.0, none_ns = 0.0;
  double all = 0.0, gate = 0.0, none = 0.0, bound = 0.0;
};

// What a fitted light's effects cost, and what they and those left off do together.
Row RowOf(const FittedLight& light) {
  Row row{light.name, true, 0.0, 0.0, 1.3, 0.0, 0.0, 0.0, 0.0};
  double kept = 1.0;
  double direct = 1.0;
  for (const EffectReport& effect : light.effects) {
    row.all_ns += effect.cost_ns;
    if (effect.state != EffectState::kOff) row.gate_ns += effect.cost_ns;
    if (effect.state == EffectState::kOff && effect.bound < 1.0 &&
        effect.reason.starts_with("at most")) {
      kept *= 1.0 - effect.bound;
    }
    direct *= 1.0 + effect.contribution.value_or(0.0);
  }
  row.all_ns += row.none_ns;
  row.gate_ns += row.none_ns;
  row.bound = 1.0 / kept - 1.0;
  row.gate = row.bound;
  row.none = direct > 0.0 ? std::abs(1.0 / direct - 1.0) : 1.0;
  return row;
}

class Canvas {
 public:
  void Add(const std::string& element) { body_ += element + "\n"; }
  void Line(const std::string& css, double x1, double y1, double x2, double y2) {
    Add("<line class=\"" + css + "\" x1=\"" + Px(x1) + "\" y1=\"" + Px(y1) + "\" x2=\"" + Px(x2) +
        "\" y2=\"" + Px(y2) + "\"/>");
  }
  void Text(const std::string& css, double x, double y, const std::string& anchor,
            const std::string& text) {
    Add("<text class=\"" + css + "\" x=\"" + Px(x) + "\" y=\"" + Px(y) + "\" text-anchor=\"" +
        anchor + "\">" + Escaped(text) + "</text>");
  }
  // Three marks that differ in shape as well as in colour.
  void All(double x, double y) {
    Add("<path class=\"gate-all\" d=\"M" + Px(x) + " " + Px(y - 6) + "L" + Px(x + 6) + " " + Px(y) +
        "L" + Px(x) + " " + Px(y + 6) + "L" + Px(x - 6) + " " + Px(y) + "Z\"/>");
  }
  void Gate(double x, double y) {
    Add("<circle class=\"gate-on\" cx=\"" + Px(x) + "\" cy=\"" + Px(y) + "\" r=\"6\"/>");
  }
  void None(double x, double y) {
    Add("<circle class=\"gate-none\" cx=\"" + Px(x) + "\" cy=\"" + Px(y) + "\" r=\"5\"/>");
  }
  [[nodiscard]] const std::string& body() const { return body_; }

 private:
  std::string body_;
};

void DrawRow(Canvas& canvas, const Row& row, double y, const Axis& cost, const Axis& error) {
  const auto placed = [](const Axis& axis, double value) {
    return axis.At(std::clamp(value, axis.low, axis.high));
  };
  canvas.Text(row.own ? "own" : "label", kBarsLeft - 18.0, y + 4.5, "end", row.name);
  canvas.Line("gate-span", cost.At(row.none_ns), y, cost.At(row.all_ns), y);
  canvas.Line("gate-span", error.from_px, y,
              placed(error, std::max({row.all, row.gate, row.none, row.bound})), y);
  canvas.None(cost.At(row.none_ns), y);
  canvas.All(cost.At(row.all_ns), y);
  canvas.Gate(cost.At(row.gate_ns), y);
  if (row.bound > 0.0) {
    const double x = placed(error, row.bound);
    canvas.Line("gate-bound", x, y - 8.0, x, y + 8.0);
  }
  canvas.None(placed(error, row.none), y);
  if (row.own) return;
  canvas.All(placed(error, row.all), y);
  canvas.Gate(placed(error, row.gate), y);
}

void DrawLegend(Canvas& canvas) {
  const double y = 20.0;
  canvas.All(kBarsLeft, y);
  canvas.Text("label", kBarsLeft + 12.0, y + 4.5, "start", "every effect");
  canvas.Gate(kBarsLeft + 122.0, y);
  canvas.Text("label", kBarsLeft + 134.0, y + 4.5, "start", "what the gate calls for");
  canvas.None(kBarsLeft + 318.0, y);
  canvas.Text("label", kBarsLeft + 330.0, y + 4.5, "start", "none: I/d²");
  canvas.Line("gate-bound", kBarsLeft + 430.0, y - 8.0, kBarsLeft + 430.0, y + 8.0);
  canvas.Text("label", kBarsLeft + 440.0, y + 4.5, "start", "what is left off, at most");
}

constexpr std::string_view kCss =
    "svg .label { font-size: 14px; }\n"
    "svg .own { font-size: 14px; font-weight: 650; }\n"
    "svg .head { font-size: 14.5px; font-weight: 650; }\n"
    "svg .gate-span { stroke: var(--rule); stroke-width: 4; stroke-linecap: round; }\n"
    "svg .gate-all { fill: var(--warn); }\n"
    "svg .gate-on { fill: var(--accent); stroke: var(--page); stroke-width: 1.4; }\n"
    "svg .gate-none { fill: var(--page); stroke: var(--soft); stroke-width: 2; }\n"
    "svg .gate-bound { stroke: var(--accent); stroke-width: 2; }\n"
    "svg .gate-tolerance { stroke: var(--ink); stroke-width: 1.4; stroke-dasharray: 6 4; }\n"
    "svg .gate-tolerance-label { fill: var(--ink); font-size: 12.5px; font-weight: 600; }\n";

}  // namespace

bool HasEffects(const std::vector<FittedLight>& lights) {
  return std::ranges::any_of(lights, [](const FittedLight& l) { return !l.effects.empty(); });
}

std::string GateFigure(const std::vector<FittedLight>& lights, double tolerance,
                       std::string_view id) {
  std::vector<Row> rows;
  for (const NamedScene& scene : LadderScenes()) {
    const GateStep step = StepOf(scene, tolerance);
    rows.push_back({step.name, false, step.cost_all_ns, step.cost_gate_ns, step.cost_none_ns,
                    step.error_all, step.error_gate, step.error_none, step.bound});
  }
  for (const FittedLight& light : lights) {
    if (!light.effects.empty()) rows.push_back(RowOf(light));
  }
  const double bottom = kBarsTop + kRow * static_cast<double>(rows.size());
  const Axis cost{AxisScale::kLog, 1.0, 20000.0, kBarsLeft, kFirstRight};
  const Axis error{AxisScale::kLog, kLeastError, kMost, kSecondLeft, kSecondRight};
  Canvas canvas;
  DrawLegend(canvas);
  canvas.Text("head", kBarsLeft, kBarsTop - 18.0, "start", "Cost of one evaluation");
  canvas.Text("head", kSecondLeft, kBarsTop - 18.0, "start", "Error against brute force");
  for (const double ns : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    canvas.Line("grid", cost.At(ns), kBarsTop, cost.At(ns), bottom);
    canvas.Text("tick", cost.At(ns), bottom + 18.0, "middle",
                ns < 1e3 ? Figure(ns) + " ns" : Figure(1e-3 * ns) + " µs");
  }
  for (const double relative : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    canvas.Line("grid", error.At(relative), kBarsTop, error.At(relative), bottom);
    canvas.Text("tick", error.At(relative), bottom + 18.0, "middle",
                relative <= kLeastError ? "≤ 0.01 %" : PercentText(relative, 1));
  }
  canvas.Line("gate-tolerance", error.At(tolerance), kBarsTop - 6.0, error.At(tolerance), bottom);
  canvas.Text("gate-tolerance-label", error.At(tolerance) + 5.0, bottom + 36.0, "middle",
              "tolerance " + PercentText(tolerance, 1));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].own && (i == 0 || !rows[i - 1].own)) {
      const double y = kBarsTop + kRow * static_cast<double>(i);
      canvas.Line("grid", 14.0, y, kSecondRight, y);
    }
    DrawRow(canvas, rows[i], kBarsTop + kRow * (static_cast<double>(i) + 0.5), cost, error);
  }
  const std::string name(id);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"wide\" id=\"" + name +
         "\" viewBox=\"0 0 " + Px(kWidth) + " " + Px(bottom + 46.0) +
         "\" role=\"img\" "
         "aria-labelledby=\"" +
         name + "-title " + name + "-desc\">\n<title id=\"" + name +
         "-title\">What the gate saves</title>\n<desc id=\"" + name +
         "-desc\">Cost of one evaluation, and its error against brute force, with every effect, "
         "with "
         "those the gate calls for and with none, for scenes from a bare bulb in a dark hall to a "
         "panel in a white "
         "room</desc>\n<style>" +
         std::string(kCss) + "</style>\n" + canvas.body() + "</svg>\n";
}

std::string GatePlot(const std::vector<FittedLight>& lights, double tolerance) {
  std::string svg = GateFigure(lights, tolerance, "gate");
  const std::string own = "<style>" + std::string(kCss) + "</style>\n";
  svg.erase(svg.find(own), own.size());
  return StandaloneSvg(std::move(svg), "svg { max-width: none; }\n" + std::string(kCss));
}

}  // namespace lightcal::report
