// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/core/statistics.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kLinearUpTo = 20.0;  // brightest over dimmest
constexpr double kMostDecades = 3.0;

// Evenly spaced along the scale, sRGB 0..255.
constexpr std::array<std::array<double, 3>, 9> kAnchors = {{{9, 11, 28},
                                                            {33, 30, 84},
                                                            {75, 37, 127},
                                                            {126, 45, 137},
                                                            {180, 57, 120},
                                                            {222, 85, 85},
                                                            {245, 134, 58},
                                                            {251, 188, 76},
                                                            {255, 244, 190}}};

std::array<std::uint8_t, 3> ColorAt(double part) {
  const double at = std::clamp(part, 0.0, 1.0) * (kAnchors.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), kAnchors.size() - 2);
  const double f = at - static_cast<double>(k);
  std::array<std::uint8_t, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = static_cast<std::uint8_t>(
        std::lround(kAnchors[k][c] + f * (kAnchors[k + 1][c] - kAnchors[k][c])));
  }
  return out;
}

double PartOf(const ValueScale& scale, double value) {
  if (scale.way == AxisScale::kLinear) return (value - scale.low) / (scale.high - scale.low);
  return value > 0.0 ? std::log(value / scale.low) / std::log(scale.high / scale.low) : 0.0;
}

// The next round number, upward or downward.
double Round(double value, bool up) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  constexpr std::array<double, 9> kRoundSteps = {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};
  const double mantissa = value / decade;
  if (up) {
    for (const double step : kRoundSteps) {
      if (mantissa <= step * (1.0 + 1e-9)) return step * decade;
    }
    return 10.0 * decade;
  }
  for (auto step = kRoundSteps.rbegin(); step != kRoundSteps.rend(); ++step) {
    if (mantissa >= *step * (1.0 - 1e-9)) return *step * decade;
  }
  return decade;
}

struct NitsRange {
  double dim, bright;  // the twentieth below which a twentieth lies, the brightest
};
NitsRange RangeOf(View2d<const float> values) {
  std::vector<float> lit;
  for (int y = 0; y < values.height(); ++y) {
    for (const float v : values.row(y)) {
      if (v > 0.0F) lit.push_back(v);
    }
  }
  if (lit.empty()) return {0.0, 1.0};
  const double bright = *std::max_element(lit.begin(), lit.end());
  return {AtRank(lit, lit.size() / 20), bright};
}

}  // namespace

ValueScale ScaleFor(View2d<const float> values, AxisScale way) {
  const NitsRange range = RangeOf(values);
  if (way == AxisScale::kLinear) return {way, 0.0, Round(range.bright, true)};
  const double least = range.bright * std::pow(10.0, -kMostDecades);
  double low = Round(std::max(range.dim, least), false);
  const double high = Round(range.bright, true);
  if (!(low < 0.5 * high)) low = 0.1 * high;
  return {way, low, high};
}

ValueScale ScaleFor(View2d<const float> values) {
  const NitsRange range = RangeOf(values);
  return ScaleFor(values,
                  range.bright > kLinearUpTo * range.dim ? AxisScale::kLog : AxisScale::kLinear);
}

std::vector<std::uint8_t> FalseColors(View2d<const float> values, const ValueScale& scale) {
  std::vector<std::uint8_t> out;
  out.reserve(3 * static_cast<std::size_t>(values.width()) * values.height());
  for (int y = 0; y < values.height(); ++y) {
    for (const float v : values.row(y)) {
      const auto color = ColorAt(PartOf(scale, double{v}));
      out.insert(out.end(), color.begin(), color.end());
    }
  }
  return out;
}

std::vector<std::uint8_t> ScaleColors(int height) {
  std::vector<std::uint8_t> out;
  for (int y = 0; y < height; ++y) {
    const auto color = ColorAt(1.0 - (y + 0.5) / height);
    out.insert(out.end(), color.begin(), color.end());
  }
  return out;
}

std::string ImageElement(PagePoint at, PagePoint size, std::string_view uri) {
  return "<image x=\"" + Px(at.first) + "\" y=\"" + Px(at.second) + "\" width=\"" + Px(size.first) +
         "\" height=\"" + Px(size.second) + "\" preserveAspectRatio=\"none\" xlink:href=\"" +
         std::string(uri) + "\"/>";
}

std::string WithXlink(std::string svg) {
  constexpr std::string_view kNamespace = " xmlns:xlink=\"http://www.w3.org/1999/xlink\"";
  return svg.insert(svg.find(" xmlns="), kNamespace);
}

Axis BarAxis(const ValueScale& scale, const ScaleBar& bar) {
  return {scale.way, scale.low, scale.high, bar.top + bar.height, bar.top};
}

std::vector<double> BarLevels(const ValueScale& scale, const ScaleBar& bar) {
  std::vector<double> levels = TicksOf(BarAxis(scale, bar), std::max(26.0, bar.height / 14.0));
  std::erase_if(levels, [&](double v) { return !(v > 0.0); });
  return levels;
}

void DrawScaleBar(Svg& svg, const ValueScale& scale, const ScaleBar& bar, std::string_view uri,
                  std::string_view unit) {
  const double right = bar.left + bar.width;
  const double bottom = bar.top + bar.height;
  svg.Element(ImageElement({bar.left, bar.top}, {bar.width, bar.height}, uri));
  svg.Path("frame", {{bar.left, bar.top}, {right, bar.top}, {right, bottom}, {bar.left, bottom}},
           true);
  const Axis axis = BarAxis(scale, bar);
  for (const double level : BarLevels(scale, bar)) {
    const double at = axis.At(level);
    svg.Line("frame", {right, at}, {right + 5.0, at});
    svg.Text("tick", {right + 9.0, at + 4.5}, "start", Figure(level));
  }
  svg.Text("axis", {bar.left, bar.top - 12.0}, "start",
           std::string(unit) + (scale.way == AxisScale::kLog ? " (log)" : ""));
}

}  // namespace lightcal::report
