// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/illuminance_figure.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/units.h"
#include "lightcal/report/contours.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kLongSide = 640.0;  // of the picture
constexpr double kShortestSide = 120.0;
constexpr double kMapLeft = 70.0, kMapTop = 52.0, kMapRight = 132.0, kMapBelow = 62.0,
                 kNoteStep = 18.0;
constexpr double kBarGap = 26.0, kBarWidth = 18.0;
constexpr double kTickGap = 46.0;
constexpr int kMostContourSamples = 256;

// Where things lie on the page.
struct Layout {
  double width, height;  // of the picture
  Axis x, y;
  explicit Layout(const IlluminanceFigure& f) {
    const double across = std::abs(f.right - f.left);
    const double up = std::abs(f.top - f.bottom);
    const double scale = kLongSide / std::max(across, up);
    width = std::max(kShortestSide, across * scale);
    height = std::max(kShortestSide, up * scale);
    const auto axis = [](double at_from, double at_to, double from, double to) {
      return at_from < at_to ? Axis{AxisScale::kLinear, at_from, at_to, from, to}
                             : Axis{AxisScale::kLinear, at_to, at_from, to, from};
    };
    x = axis(f.left, f.right, kMapLeft, kMapLeft + width);
    y = axis(f.bottom, f.top, kMapTop + height, kMapTop);
  }
  [[nodiscard]] ScaleBar bar() const {
    return {kMapLeft + width + kBarGap, kMapTop, kBarWidth, height};
  }
};

std::string Turned(PagePoint at, double degrees, std::string_view css, std::string_view text) {
  return "<text class=\"" + std::string(css) + "\" text-anchor=\"middle\" transform=\"translate(" +
         Px(at.first) + " " + Px(at.second) + ") rotate(" + Px(degrees) + ")\">" + Escaped(text) +
         "</text>";
}

// Ticks outside a frame.
void DrawAxes(Svg& svg, const IlluminanceFigure& figure, const Layout& layout) {
  const double bottom = kMapTop + layout.height;
  for (const double tick : TicksOf(layout.x, kTickGap)) {
    const double at = layout.x.At(tick);
    svg.Line("frame", {at, bottom}, {at, bottom + 5.0});
    svg.Text("tick", {at, bottom + 20.0}, "middle", Figure(tick));
  }
  for (const double tick : TicksOf(layout.y, kTickGap)) {
    const double at = layout.y.At(tick);
    svg.Line("frame", {kMapLeft - 5.0, at}, {kMapLeft, at});
    svg.Text("tick", {kMapLeft - 10.0, at + 4.5}, "end", Figure(tick));
  }
  svg.Text("axis", {kMapLeft + 0.5 * layout.width, bottom + 42.0}, "middle", figure.x_title);
  svg.Element(Turned({18.0, kMapTop + 0.5 * layout.height}, -90.0, "axis", figure.y_title));
  svg.Path("frame",
           {{kMapLeft, kMapTop},
            {kMapLeft + layout.width, kMapTop},
            {kMapLeft + layout.width, bottom},
            {kMapLeft, bottom}},
           true);
}

// A label lies on its line where the line is straightest and no other label is near.
class Labels {
 public:
  explicit Labels(const Layout& layout) : layout_(layout) {}

  void KeepOff(PagePoint at) { taken_.push_back(at); }

  void Put(Svg& svg, const Contour& line, const std::string& text) {
    const double half = 3.6 * static_cast<double>(text.size()) + 6.0;
    const int reach = 4;
    const int count = static_cast<int>(line.size());
    double best = -1.0;
    int best_at = 0;
    for (int i = reach; i < count - reach; ++i) {
      const PagePoint& at = line[static_cast<std::size_t>(i)];
      const bool inside = at.first > kMapLeft + half &&
                          at.first < kMapLeft + layout_.width - half &&
                          at.second > kMapTop + 14.0 && at.second < kMapTop + layout_.height - 14.0;
      if (!inside) continue;
      double nearest = 1e9;
      for (const PagePoint& other : taken_) {
        nearest = std::min(nearest, std::hypot(other.first - at.first, other.second - at.second));
      }
      if (nearest < 2.0 * half || nearest < 34.0) continue;
      const double score = std::min(nearest, 160.0) + 0.2 * Level(line, i, reach);
      if (score > best) {
        best = score;
        best_at = i;
      }
    }
    if (best < 0.0) return;
    const PagePoint at = line[static_cast<std::size_t>(best_at)];
    taken_.push_back(at);
    const PagePoint& a = line[static_cast<std::size_t>(best_at - reach)];
    const PagePoint& b = line[static_cast<std::size_t>(best_at + reach)];
    double degrees =
        DegreesFromRadians(Radians(std::atan2(b.second - a.second, b.first - a.first)));
    if (degrees > 90.0) degrees -= 180.0;
    if (degrees < -90.0) degrees += 180.0;
    const double turn = degrees * kRadiansPerDegree;
    const PagePoint base = {at.first - 4.2 * std::sin(turn), at.second + 4.2 * std::cos(turn)};
    svg.Element(Turned(base, degrees, "isolabel halo", text));
    svg.Element(Turned(base, degrees, "isolabel", text));
  }

 private:
  // 0..100: how level the line runs.
  static double Level(const Contour& line, int i, int reach) {
    const PagePoint& a = line[static_cast<std::size_t>(i - reach)];
    const PagePoint& b = line[static_cast<std::size_t>(i + reach)];
    const double across = std::abs(b.first - a.first);
    return 100.0 * across / std::max(1e-9, std::hypot(across, b.second - a.second));
  }
  const Layout& layout_;
  std::vector<PagePoint> taken_;
};

void DrawIsolux(Svg& svg, const IlluminanceFigure& figure, const ValueScale& scale,
                const Layout& layout, Labels& labels) {
  const ReducedField field = Reduce(figure.lux, kMostContourSamples);
  const double per_x = layout.width * field.block / figure.lux.width();
  const double per_y = layout.height * field.block / figure.lux.height();
  const double shortest = 12.0;
  std::vector<std::pair<Contour, std::string>> to_label;
  for (const double level : BarLevels(scale, layout.bar())) {
    std::size_t labelled = 0;
    for (Contour& line : ContoursOf(field.view(), level)) {
      for (PagePoint& p : line) {
        p = {kMapLeft + (p.first + 0.5) * per_x, kMapTop + (p.second + 0.5) * per_y};
      }
      svg.Path("isolux halo", line);
      svg.Path("isolux", line);
      if (static_cast<double>(line.size()) >= shortest && labelled++ < 2) {
        to_label.emplace_back(std::move(line), Figure(level));
      }
    }
  }
  for (const auto& [line, text] : to_label) labels.Put(svg, line, text);
}

void DrawLamps(Svg& svg, const IlluminanceFigure& figure, const Layout& layout) {
  for (const LampMark& lamp : figure.lamps) {
    if (!layout.x.Holds(lamp.x) || !layout.y.Holds(lamp.y)) continue;
    const PagePoint at = {layout.x.At(lamp.x), layout.y.At(lamp.y)};
    const double length = std::hypot(lamp.aim_x, lamp.aim_y);
    const double side_x = layout.x.from_px < layout.x.to_px ? 1.0 : -1.0;
    if (length > 0.05) {
      const PagePoint to = {at.first + side_x * 30.0 * lamp.aim_x, at.second - 30.0 * lamp.aim_y};
      svg.Line("lamp halo", at, to);
      svg.Line("lamp", at, to);
    }
    svg.Circle("lamp halo", at, 6.0);
    svg.Circle("lamp", at, 6.0, lamp.name);
    svg.Circle("lampdot", at, 1.8);
    const bool left = at.first > kMapLeft + 0.8 * layout.width;
    const PagePoint label = {at.first + (left ? -12.0 : 12.0), at.second + 4.5};
    svg.Text("isolabel halo", label, left ? "end" : "start", lamp.name);
    svg.Text("isolabel", label, left ? "end" : "start", lamp.name);
  }
}

// White on a dark halo reads on every colour of the scale.
constexpr std::string_view kStyle = R"css(
svg { background: var(--page); font-family: system-ui, sans-serif; max-width: none; }
svg .title { font-size: 17px; font-weight: 600; }
svg .isolux { fill: none; stroke: #ffffff; stroke-width: 1.1; stroke-linejoin: round; }
svg .isolux.halo { stroke: #000000; stroke-width: 2.6; stroke-opacity: .35; }
svg .isolabel { fill: #ffffff; font-size: 12.5px; font-weight: 600; }
svg .isolabel.halo { stroke: #000000; stroke-width: 3.4; stroke-opacity: .75; stroke-linejoin: round; }
svg .lamp { fill: none; stroke: #ffffff; stroke-width: 1.8; }
svg .lamp.halo { stroke: #000000; stroke-width: 4.4; stroke-opacity: .75; }
svg .lampdot { fill: #ffffff; }
)css";

}  // namespace

std::string IlluminancePicture(const IlluminanceFigure& figure, const ValueScale& scale,
                               std::string_view image_uri, std::string_view scale_uri) {
  const Layout layout(figure);
  const double notes = kNoteStep * static_cast<double>(figure.notes.size());
  const PagePoint size = {kMapLeft + layout.width + kMapRight,
                          kMapTop + layout.height + kMapBelow + notes};
  Svg svg("illuminance", figure.title, "Illuminance map in lux, written by lightcal", size);
  svg.Text("title", {kMapLeft, 28.0}, "start", figure.title);
  svg.Element(ImageElement({kMapLeft, kMapTop}, {layout.width, layout.height}, image_uri));
  svg.Element("<clipPath id=\"map\"><rect x=\"" + Px(kMapLeft) + "\" y=\"" + Px(kMapTop) +
              "\" width=\"" + Px(layout.width) + "\" height=\"" + Px(layout.height) +
              "\"/></clipPath><g clip-path=\"url(#map)\">");
  Labels labels(layout);
  for (const LampMark& lamp : figure.lamps) {
    labels.KeepOff({layout.x.At(lamp.x), layout.y.At(lamp.y)});
  }
  DrawIsolux(svg, figure, scale, layout, labels);
  DrawLamps(svg, figure, layout);
  svg.Element("</g>");
  DrawAxes(svg, figure, layout);
  DrawScaleBar(svg, scale, layout.bar(), scale_uri, "lux");
  double y = kMapTop + layout.height + kMapBelow + 4.0;
  for (const std::string& note : figure.notes) {
    svg.Text("note", {kMapLeft, y}, "start", note);
    y += kNoteStep;
  }
  return StandaloneSvg(WithXlink(svg.Finish()), kStyle);
}

}  // namespace lightcal::report
