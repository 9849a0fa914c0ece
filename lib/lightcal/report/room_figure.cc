// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/light/wall_prior.h"
#include "lightcal/records/light_curve.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/label_placement.h"
#include "lightcal/report/readings.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr int kRoomSteps = 60;

const LampInRoom* LikeliestOf(const FittedLight& light) {
  const auto most = std::ranges::max_element(light.in_room, {}, &LampInRoom::weight);
  return most == light.in_room.end() || !most->ln_b ? nullptr : &*most;
}

// E d^2 of the light from the walls, by the likeliest of what lamp and room may be.
double WallsTimesSquare(const LampInRoom& one, double distance_m) {
  const double x = std::log(distance_m / kWallReference_m);
  const double ln = one.ln_intensity + *one.ln_b + one.slope * x + one.bend * x * x;
  return std::exp(ln) * distance_m * distance_m;
}

// The lamp's own E d^2: below its intensity near where its light starts d0 behind the reference
// point, or where it is large.
class LampCurve {
 public:
  explicit LampCurve(const FittedLight& light)
      : curve_(*LightCurve::Of(light)),
        ambient_lx_(light.ambient_lx ? light.ambient_lx->value : 0.0) {}

  [[nodiscard]] double At(double distance_m) const {
    return (curve_.LuxAt(distance_m) - ambient_lx_) * distance_m * distance_m;
  }
  // Where a curve out to `farthest` starts: before the lamp's light does, E d^2 means nothing.
  [[nodiscard]] double NearestFor(double farthest_m) const {
    return std::max(0.02 * farthest_m, 0.05 * farthest_m + curve_.nearest_m());
  }

 private:
  LightCurve curve_;
  double ambient_lx_;
};

// Evenly, from where the curve starts.
std::vector<double> DistancesFor(const LampCurve& lamp, const Axis& x) {
  std::vector<double> distances;
  const double nearest = lamp.NearestFor(x.high);
  for (int i = 0; i <= kRoomSteps; ++i) {
    distances.push_back(nearest + (x.high - nearest) * i / kRoomSteps);
  }
  return distances;
}

// A reading as people multiply it in a spreadsheet; one that was turned, or beside the axis, as if
// it faced the lamp.
struct Dot {
  const ResidualRow* row;
  double distance_m, value, factor;
};

std::vector<Dot> DotsOf(const std::vector<ResidualRow>& rows) {
  std::vector<Dot> dots;
  for (const ResidualRow& row : rows) {
    const double d = *row.distance_m;
    if (!(row.measured_lx > 0.0)) continue;
    dots.push_back(
        {&row, d, FacingLux(row) * d * d, std::exp(std::min(kZ95 * row.sigma_relative, 3.0))});
  }
  return dots;
}

void DrawBand(Svg& svg, const Uncertain& u, const LampCurve& lamp, const Axis& x, const Axis& y) {
  const double low = std::max(0.0, LowEnd(u)) / u.value;
  const double high = HighEnd(u) / u.value;
  std::vector<PagePoint> line;
  std::vector<PagePoint> outline;
  std::vector<PagePoint> back;
  for (const double d : DistancesFor(lamp, x)) {
    const double value = lamp.At(d);
    line.emplace_back(x.At(d), y.At(std::min(y.high, value)));
    outline.emplace_back(x.At(d), y.At(low * value));
    back.emplace_back(x.At(d), y.At(std::min(y.high, high * value)));
  }
  outline.insert(outline.end(), back.rbegin(), back.rend());
  svg.Path("band", outline, true);
  svg.Path("model", line);
}

void DrawWedge(Svg& svg, const LampCurve& lamp, const LampInRoom& one, const Axis& x,
               const Axis& y) {
  std::vector<PagePoint> outline;
  std::vector<PagePoint> back;
  for (const double d : DistancesFor(lamp, x)) {
    const double alone = lamp.At(d);
    outline.emplace_back(x.At(d), y.At(alone + WallsTimesSquare(one, d)));
    back.emplace_back(x.At(d), y.At(alone));
  }
  outline.insert(outline.end(), back.rbegin(), back.rend());
  svg.Path("wedge", outline, true);
}

void DrawDot(Svg& svg, const Dot& dot, const LampCurve& lamp, const LampInRoom* room, const Axis& x,
             const Axis& y) {
  const PagePoint at{x.At(dot.distance_m), y.At(dot.value)};
  if (!dot.row->used) {
    svg.Cross("rejected", at, 5.0, TooltipOf(*dot.row));
    return;
  }
  // A card took the room away: from where the reading stood to what the lamp alone gives.
  if (room != nullptr && !dot.row->walls_lx) {
    const double above = lamp.At(dot.distance_m) + WallsTimesSquare(*room, dot.distance_m);
    svg.Line("guide", {at.first, y.At(std::min(above, y.high))}, at);
  }
  svg.Line("whisker", {at.first, y.At(dot.value / dot.factor)},
           {at.first, y.At(dot.value * dot.factor)});
  svg.Circle("used", at, 4.5, TooltipOf(*dot.row));
}

// Beside the lamp's line, below it at the left where no reading stands there.
void NameLamp(Svg& svg, const Uncertain& u, const std::vector<Dot>& dots, const Axis& x,
              const Axis& y) {
  constexpr double kMark = 7.0;  // px about a reading
  const std::string name = "your lamp, " + Interval(u, "cd");
  const double line = y.At(u.value);
  const PagePoint left_below{x.from_px + 8.0, line + 18.0};
  PagePoint best = left_below;
  for (const PagePoint& at : {left_below, PagePoint{left_below.first, line - 8.0},
                              PagePoint{x.to_px - 8.0 - NoteWidth(name), line - 8.0},
                              PagePoint{x.to_px - 8.0 - NoteWidth(name), line + 18.0}}) {
    const LabelBox box{at.first, at.second - kNoteLine, at.first + NoteWidth(name),
                       at.second + 3.0};
    const bool free = std::ranges::none_of(dots, [&](const Dot& dot) {
      const double px = x.At(dot.distance_m);
      const double py = y.At(dot.value);
      return Overlap(box, {px - kMark, py - kMark, px + kMark, py + kMark});
    });
    if (!free) continue;
    best = at;
    break;
  }
  svg.Text("note halo", best, "start", name);
}

}  // namespace

std::string RoomFigure(const FittedLight& light, std::string_view id) {
  const auto rows = RowsWithDistance(light);
  if (!light.intensity_cd || !(light.intensity_cd->value > 0.0) || rows.empty()) return "";
  const Uncertain& u = *light.intensity_cd;
  const std::vector<Dot> dots = DotsOf(rows);
  const LampInRoom* const room = LikeliestOf(light);
  const LampCurve lamp(light);
  double farthest = 0.0;
  double most = std::min(HighEnd(u), 3.0 * u.value);
  for (const Dot& dot : dots) {
    farthest = std::max(farthest, dot.distance_m);
    most = std::max(most, dot.value * std::min(dot.factor, 1.3));
  }
  if (!(farthest > 0.0)) return "";
  constexpr double kAirAround = 1.12;
  farthest *= kAirAround;
  if (room != nullptr) {
    const double whole = lamp.At(farthest) + WallsTimesSquare(*room, farthest);
    most = std::max(most, std::min(whole, 2.0 * most));
  }
  const Axis x{AxisScale::kLinear, 0.0, farthest, Svg::Area().left, Svg::Area().right};
  const Axis y{AxisScale::kLinear, 0.0, kAirAround * most, Svg::Area().bottom, Svg::Area().top};
  Svg svg(
      std::string(id), "What the room adds",
      "Illuminance times distance squared: flat for a lamp alone, rising with the walls' light");
  svg.Axes(x, y, "distance (m)",
           SomeTurned(rows) ? "lux facing the lamp × metres² (cd)" : "lux × metres² (cd)");
  svg.BeginPlot();
  if (room != nullptr) DrawWedge(svg, lamp, *room, x, y);
  DrawBand(svg, u, lamp, x, y);
  for (const Dot& dot : dots) DrawDot(svg, dot, lamp, room, x, y);
  svg.EndPlot();
  const double right = x.to_px - 8.0;
  NameLamp(svg, u, dots, x, y);
  if (room != nullptr) {
    const double d = 0.93 * farthest;
    const double walls = WallsTimesSquare(*room, d);
    constexpr double kRoomForWords = 22.0;  // px
    if (y.At(0.0) - y.At(walls) > kRoomForWords) {
      svg.Text("note halo", {right, y.At(lamp.At(d) + 0.6 * walls) + 4.0}, "end", "your room");
    }
  }
  return svg.Finish();
}

}  // namespace lightcal::report
