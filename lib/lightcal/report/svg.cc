// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kTickGapX = 48.0;
constexpr double kTickGapY = 26.0;
constexpr PlotArea kArea;

std::string Attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}

std::string Tooltip(std::string_view text) {
  return text.empty() ? "" : "<title>" + Escaped(text) + "</title>";
}

// Linear axes show every tick with the same decimals (0.50, 0.52); logarithmic ones as they come.
std::vector<std::string> TickLabels(const Axis& axis, const std::vector<double>& ticks) {
  std::vector<std::string> labels;
  std::size_t decimals = 0;
  for (const double tick : ticks) {
    labels.push_back(Figure(tick));
    const std::size_t point = labels.back().find('.');
    if (point != std::string::npos) decimals = std::max(decimals, labels.back().size() - point - 1);
  }
  if (axis.scale == AxisScale::kLog || decimals > 6) return labels;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    labels[i] = Fixed(ticks[i], static_cast<int>(decimals));
  }
  return labels;
}

}  // namespace

// Hundredths, as ShortestText writes them.
std::string Px(double value) {
  constexpr double kShortByDigits = 1e6;  // hundredths, below which no exponent is shorter
  const double hundredths = std::round(value * 100.0);
  if (!(std::abs(hundredths) < kShortByDigits)) return ShortestText(hundredths / 100.0);
  std::array<char, 12> buffer;
  char* const end = buffer.data() + buffer.size();
  char* at = end;
  const auto put = [&at](int digit) { *--at = static_cast<char>('0' + digit); };
  int left = static_cast<int>(std::abs(hundredths));
  const int part = left % 100;
  if (part % 10 != 0) put(part % 10);
  if (part != 0) {
    put(part / 10);
    *--at = '.';
  }
  left /= 100;
  do {
    put(left % 10);
    left /= 10;
  } while (left > 0);
  if (hundredths < 0.0) *--at = '-';
  return {at, end};
}

std::string PathData(const std::vector<PagePoint>& points, bool closed) {
  std::string data;
  for (const auto& [x, y] : points) {
    data += data.empty() ? 'M' : 'L';
    data += Px(x);
    data += ' ';
    data += Px(y);
  }
  if (closed) data += 'Z';
  return data;
}

const PlotArea& Svg::Area() { return kArea; }

Svg::Svg(std::string id, std::string_view title, std::string_view description, PagePoint size)
    : id_(std::move(id)), size_(size) {
  body_ = "<title" + Attribute("id", id_ + "-title") + ">" + Escaped(title) + "</title>\n<desc" +
          Attribute("id", id_ + "-desc") + ">" + Escaped(description) + "</desc>\n";
  body_ += "<clipPath" + Attribute("id", id_ + "-clip") + "><rect" +
           Attribute("x", Px(kArea.left)) + Attribute("y", Px(kArea.top)) +
           Attribute("width", Px(kArea.right - kArea.left)) +
           Attribute("height", Px(kArea.bottom - kArea.top)) + "/></clipPath>\n";
}

void Svg::Line(std::string_view css, PagePoint from, PagePoint to) {
  body_ += "<line" + Attribute("class", css) + Attribute("x1", Px(from.first)) +
           Attribute("y1", Px(from.second)) + Attribute("x2", Px(to.first)) +
           Attribute("y2", Px(to.second)) + "/>\n";
}

void Svg::Path(std::string_view css, const std::vector<PagePoint>& points, bool closed) {
  body_ += "<path" + Attribute("class", css) + Attribute("d", PathData(points, closed)) + "/>\n";
}

void Svg::Circle(std::string_view css, PagePoint centre, double radius, std::string_view tooltip) {
  body_ += "<circle" + Attribute("class", css) + Attribute("cx", Px(centre.first)) +
           Attribute("cy", Px(centre.second)) + Attribute("r", Px(radius)) + ">" +
           Tooltip(tooltip) + "</circle>\n";
}

void Svg::Cross(std::string_view css, PagePoint centre, double half, std::string_view tooltip) {
  const auto [x, y] = centre;
  const std::string data = PathData({{x - half, y - half}, {x + half, y + half}}, false) +
                           PathData({{x - half, y + half}, {x + half, y - half}}, false);
  body_ += "<path" + Attribute("class", css) + Attribute("d", data) + ">" + Tooltip(tooltip) +
           "</path>\n";
}

void Svg::Text(std::string_view css, PagePoint at, std::string_view anchor, std::string_view text) {
  body_ += "<text" + Attribute("class", css) + Attribute("x", Px(at.first)) +
           Attribute("y", Px(at.second)) + Attribute("text-anchor", anchor) + ">" + Escaped(text) +
           "</text>\n";
}

void Svg::Element(std::string_view markup) { body_ += std::string(markup) + "\n"; }

void Svg::Axes(const Axis& x, const Axis& y, std::string_view x_title, std::string_view y_title) {
  const auto x_ticks = TicksOf(x, kTickGapX);
  const auto x_labels = TickLabels(x, x_ticks);
  for (std::size_t i = 0; i < x_ticks.size(); ++i) {
    const double at = x.At(x_ticks[i]);
    Line("grid", {at, kArea.top}, {at, kArea.bottom});
    // Where both axes begin at 0, the other's says so.
    const bool corner = x_ticks[i] == 0.0 && at <= kArea.left && y.low == 0.0;
    if (!corner) Text("tick", {at, kArea.bottom + 18.0}, "middle", x_labels[i]);
  }
  const auto y_ticks = TicksOf(y, kTickGapY);
  const auto y_labels = TickLabels(y, y_ticks);
  for (std::size_t i = 0; i < y_ticks.size(); ++i) {
    const double at = y.At(y_ticks[i]);
    Line("grid", {kArea.left, at}, {kArea.right, at});
    Text("tick", {kArea.left - 8.0, at + 4.0}, "end", y_labels[i]);
  }
  Path("frame", {{kArea.left, kArea.top}, {kArea.left, kArea.bottom}, {kArea.right, kArea.bottom}});
  Text("axis", {(kArea.left + kArea.right) / 2.0, kArea.bottom + 42.0}, "middle", x_title);
  const double middle = (kArea.top + kArea.bottom) / 2.0;
  body_ += "<text" + Attribute("class", "axis") + Attribute("text-anchor", "middle") +
           Attribute("transform", "translate(14 " + Px(middle) + ") rotate(-90)") + ">" +
           Escaped(y_title) + "</text>\n";
}

void Svg::BeginPlot() { body_ += "<g" + Attribute("clip-path", "url(#" + id_ + "-clip)") + ">\n"; }
void Svg::EndPlot() { body_ += "</g>\n"; }

std::string Svg::Finish() const {
  return "<svg" + Attribute("xmlns", "http://www.w3.org/2000/svg") + Attribute("id", id_) +
         Attribute("viewBox", "0 0 " + Px(size_.first) + " " + Px(size_.second)) +
         Attribute("role", "img") + Attribute("aria-labelledby", id_ + "-title " + id_ + "-desc") +
         ">\n" + body_ + "</svg>\n";
}

}  // namespace lightcal::report
