// SPDX-License-Identifier: Apache-2.0
// Builds the SVG of one figure: a frame with axes, and marks inside it. Colours and line widths are
// classes of the page's style sheet, so one figure serves screen, dark screen and paper.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/report/axis.h"

namespace lightcal::report {

// A page coordinate with at most two decimals ("120.5").
[[nodiscard]] std::string Px(double value);

using PagePoint = std::pair<double, double>;

// "M1 2L3 4", and Z where the last joins the first.
[[nodiscard]] std::string PathData(const std::vector<PagePoint>& points, bool closed);

inline constexpr double kFigureWidth = 480.0;
inline constexpr double kFigureHeight = 340.0;

// The area inside the axes, in figure coordinates.
struct PlotArea {
  double left = 84.0, right = 468.0, top = 16.0, bottom = 286.0;
};

class Svg {
 public:
  // id is unique in the page; title and description are read out by screen readers.
  Svg(std::string id, std::string_view title, std::string_view description,
      PagePoint size = {kFigureWidth, kFigureHeight});

  void Line(std::string_view css, PagePoint from, PagePoint to);
  // Straight pieces through the points; closed joins the last to the first.
  void Path(std::string_view css, const std::vector<PagePoint>& points, bool closed = false);
  void Circle(std::string_view css, PagePoint centre, double radius, std::string_view tooltip = {});
  // An x of half-width `half`.
  void Cross(std::string_view css, PagePoint centre, double half, std::string_view tooltip = {});
  // anchor: start, middle, end.
  void Text(std::string_view css, PagePoint at, std::string_view anchor, std::string_view text);

  // Any other element, written out.
  void Element(std::string_view markup);

  // Frame, grid, tick labels and axis titles ("distance (m)").
  void Axes(const Axis& x, const Axis& y, std::string_view x_title, std::string_view y_title);

  // Everything until EndPlot is clipped to the plot area.
  void BeginPlot();
  void EndPlot();

  [[nodiscard]] std::string Finish() const;
  [[nodiscard]] static const PlotArea& Area();

 private:
  std::string id_;
  PagePoint size_;
  std::string body_;
};

}  // namespace lightcal::report
