// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/swatch.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

// Half the height of the window in v'; the width follows, so that both axes have one scale.
constexpr double kHalfHeight = 0.045;
constexpr double kDuvGuide = 0.006;
constexpr double kIsothermDuv = 0.012;
constexpr double kHottest_mired = 40.0;    // 25 000 K
constexpr double kColdest_mired = 1000.0;  // 1000 K
constexpr int kLocusSteps = 160;
constexpr int kEllipseSteps = 72;
constexpr double kLeastUv = 1e-3;  // below it lies no colour

struct Window {
  Axis u, v;
  [[nodiscard]] PagePoint At(Uv1976 c) const { return {u.At(c.u), v.At(c.v)}; }
  [[nodiscard]] bool Holds(Uv1976 c) const { return u.Holds(c.u) && v.Holds(c.v); }
};

Uv1976 AtMired(double mired, double duv) {
  const Uv1960 uv = UvFromCct(KelvinFromMireds(Mireds(mired)), duv);
  return {uv.u, 1.5 * uv.v};
}

std::optional<Uv1976> PointOf(const FittedColor& color) {
  if (color.xy && color.xy->y > 0.0) return Uv1976FromXy(*color.xy);
  if (!color.cct_K || !(color.cct_K->value > 0.0)) return std::nullopt;
  return AtMired(1e6 / color.cct_K->value, color.duv ? color.duv->value : 0.0);
}

struct LocusPlace {
  Uv1976 on, across;  // across: what a Duv of 1 adds
  [[nodiscard]] Uv1976 At(double duv) const {
    return {on.u + duv * across.u, on.v + duv * across.v};
  }
};

// In equal steps of mireds: the same of every figure, at 471 exponentials a place.
const std::array<LocusPlace, kLocusSteps + 1>& Locus() {
  static const auto locus = [] {
    std::array<LocusPlace, kLocusSteps + 1> places{};
    for (int i = 0; i <= kLocusSteps; ++i) {
      const double mired = kHottest_mired + (kColdest_mired - kHottest_mired) * i / kLocusSteps;
      const Uv1976 on = AtMired(mired, 0.0);
      const Uv1976 off = AtMired(mired, 1.0);
      places[static_cast<std::size_t>(i)] = {on, {off.u - on.u, off.v - on.v}};
    }
    return places;
  }();
  return locus;
}

Uv1976 NearestOnLocus(Uv1976 point) {
  return std::ranges::min(Locus(), {},
                          [&](const LocusPlace& place) {
                            return std::hypot(place.on.u - point.u, place.on.v - point.v);
                          })
      .on;
}

// The light in the middle; of one far off the locus as much as shows both, where colours are.
Window Around(Uv1976 light) {
  constexpr double kAirAround = 1.3;
  const PlotArea& area = Svg::Area();
  const double aspect = (area.right - area.left) / (area.bottom - area.top);
  const Uv1976 locus = NearestOnLocus(light);
  const double needed = 0.5 * kAirAround *
                        std::max(std::abs(locus.v - light.v), std::abs(locus.u - light.u) / aspect);
  const bool far = 2.0 * needed > kHalfHeight;
  const double half = far ? std::max(needed, kHalfHeight) : kHalfHeight;
  Uv1976 centre = far ? Uv1976{0.5 * (light.u + locus.u), 0.5 * (light.v + locus.v)} : light;
  centre = {std::max(centre.u, half * aspect), std::max(centre.v, half)};
  return {{AxisScale::kLinear, centre.u - half * aspect, centre.u + half * aspect, area.left,
           area.right},
          {AxisScale::kLinear, centre.v - half, centre.v + half, area.bottom, area.top}};
}

// What the colours around here look like, roughly: one gradient across, one up and down over it.
void DrawField(Svg& svg, const Window& window, Uv1976 centre, const std::string& id) {
  constexpr int kStops = 6;
  const PlotArea& area = Svg::Area();
  const auto gradient = [&](const std::string& name, bool across) {
    std::string markup = "<linearGradient id=\"" + name + "\" x1=\"0\" y1=\"0\" x2=\"" +
                         (across ? "1" : "0") + "\" y2=\"" + (across ? "0" : "1") + "\">";
    for (int i = 0; i <= kStops; ++i) {
      const double part = static_cast<double>(i) / kStops;
      const double u = across ? std::lerp(window.u.low, window.u.high, part) : centre.u;
      const double v = across ? centre.v : std::lerp(window.v.high, window.v.low, part);
      const Xy xy = XyFromUv1960({std::max(u, kLeastUv), std::max(v, kLeastUv) / 1.5});
      markup += "<stop offset=\"" + Px(part) + "\" stop-color=\"" + SwatchOf(xy) + "\"/>";
    }
    return markup + "</linearGradient>";
  };
  svg.Element(gradient(id + "-across", true) + gradient(id + "-up", false));
  for (const char* name : {"-across", "-up"}) {
    svg.Element("<rect class=\"field" + std::string(name) + "\" x=\"" + Px(area.left) + "\" y=\"" +
                Px(area.top) + "\" width=\"" + Px(area.right - area.left) + "\" height=\"" +
                Px(area.bottom - area.top) + "\" fill=\"url(#" + id + name + ")\"/>");
  }
}

void DrawLocus(Svg& svg, const Window& window, double duv, std::string_view css) {
  std::vector<PagePoint> points;
  for (const LocusPlace& place : Locus()) points.push_back(window.At(place.At(duv)));
  svg.Path(css, points);
}

// Short lines across the locus; those whose label would leave the plot or touch the last one go
// bare.
void DrawIsotherms(Svg& svg, const Window& window) {
  constexpr std::array<double, 18> kKelvins = {1500, 1800, 2000, 2200,  2500,  2700,
                                               3000, 3200, 3500, 4000,  4500,  5000,
                                               5600, 6500, 8000, 10000, 15000, 20000};
  constexpr double kLabelGap = 60.0;
  const PlotArea& area = Svg::Area();
  double last_x = std::numeric_limits<double>::infinity();
  for (const double kelvin : kKelvins) {
    const double mired = 1e6 / kelvin;
    if (!window.Holds(AtMired(mired, 0.0))) continue;
    const PagePoint below = window.At(AtMired(mired, -kIsothermDuv));
    svg.Line("isotherm", window.At(AtMired(mired, kIsothermDuv)), below);
    const PagePoint label = {below.first, below.second + 14.0};
    const bool inside = label.first > area.left + 22.0 && label.first < area.right - 26.0 &&
                        label.second < area.bottom - 4.0;
    if (!inside || last_x - label.first < kLabelGap) continue;
    svg.Text("note halo", label, "middle", Figure(kelvin) + " K");
    last_x = label.first;
  }
}

// The 95 % region of (mired, Duv), taken as independent.
void DrawEllipse(Svg& svg, const Window& window, const FittedColor& color) {
  if (!color.cct_K || !(color.cct_K->u95 > 0.0)) return;
  const double kelvin = color.cct_K->value;
  const double half_mired = 1e6 / kelvin * std::min(color.cct_K->u95 / kelvin, 0.5);
  const double duv = color.duv ? color.duv->value : 0.0;
  const double half_duv = color.duv ? color.duv->u95 : 0.0;
  std::vector<PagePoint> points;
  for (int i = 0; i < kEllipseSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kEllipseSteps;
    const Uv1976 c =
        AtMired(1e6 / kelvin + half_mired * std::cos(angle), duv + half_duv * std::sin(angle));
    points.push_back(window.At(c));
  }
  svg.Path("ellipse", points, true);
}

}  // namespace

std::string ChromaticityFigure(const FittedLight& light, std::string_view id) {
  const auto point = PointOf(light.color);
  if (!point) return "";
  const Window window = Around(*point);
  Svg svg(std::string(id), "Chromaticity",
          "CIE 1976 u'v' around the light, with the Planckian locus and correlated colour "
          "temperatures");
  DrawField(svg, window, *point, std::string(id));
  svg.Axes(window.u, window.v, "u′", "v′");
  svg.BeginPlot();
  DrawIsotherms(svg, window);
  DrawLocus(svg, window, kDuvGuide, "guide");
  DrawLocus(svg, window, -kDuvGuide, "guide");
  DrawLocus(svg, window, 0.0, "locus");
  DrawEllipse(svg, window, light.color);
  svg.Circle("used", window.At(*point), 4.5,
             "u′ " + Fixed(point->u, 4) + ", v′ " + Fixed(point->v, 4));
  svg.EndPlot();
  return svg.Finish();
}

}  // namespace lightcal::report
