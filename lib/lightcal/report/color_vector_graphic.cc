// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/color_vector_graphic.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kSize = 480.0;
constexpr double kCentre = kSize / 2.0;
constexpr double kRadius = 150.0;  // of the reference circle
constexpr double kBinTurn = 2.0 * std::numbers::pi / kHueBinCount;

struct Arrow {
  PagePoint from, to;
  std::size_t bin;
};

PagePoint OnPage(double x, double y) { return {kCentre + kRadius * x, kCentre - kRadius * y}; }

std::vector<Arrow> ArrowsOf(const GamutAndBins& gamut) {
  std::vector<Arrow> arrows;
  for (std::size_t i = 0; i < gamut.bins.size(); ++i) {
    const HueBin& bin = gamut.bins[i];
    if (bin.samples == 0) continue;
    const double chroma = std::hypot(bin.reference_a, bin.reference_b);
    const double x = bin.reference_a / chroma;
    const double y = bin.reference_b / chroma;
    arrows.push_back({OnPage(x, y),
                      OnPage(x + (bin.test_a - bin.reference_a) / chroma,
                             y + (bin.test_b - bin.reference_b) / chroma),
                      i});
  }
  return arrows;
}

// A hue for each bin, red at the first.
std::string BinColor(std::size_t bin) {
  const double degrees = (static_cast<double>(bin) + 0.5) * 360.0 / kHueBinCount;
  return "hsl(" + Px(degrees) + ",60%,45%)";
}

std::string Point(PagePoint p) { return Px(p.first) + " " + Px(p.second); }

std::string Line(std::string_view attributes, PagePoint from, PagePoint to) {
  return "<line " + std::string(attributes) + " x1=\"" + Px(from.first) + "\" y1=\"" +
         Px(from.second) + "\" x2=\"" + Px(to.first) + "\" y2=\"" + Px(to.second) + "\"/>\n";
}

std::string Label(PagePoint at, std::string_view anchor, int size, std::string_view text) {
  return "<text x=\"" + Px(at.first) + "\" y=\"" + Px(at.second) + "\" text-anchor=\"" +
         std::string(anchor) + "\" font-size=\"" + std::to_string(size) + "\">" + Escaped(text) +
         "</text>\n";
}

std::string Circle(double radius, std::string_view style) {
  return "<circle cx=\"" + Px(kCentre) + "\" cy=\"" + Px(kCentre) + "\" r=\"" + Px(radius) +
         "\" fill=\"none\" " + std::string(style) + "/>\n";
}

// A smooth closed curve through the points: cubic Bezier pieces of a Catmull-Rom spline.
std::string SmoothPath(const std::vector<Arrow>& arrows) {
  const std::size_t n = arrows.size();
  const auto at = [&](std::size_t i) { return arrows[i % n].to; };
  std::string data = "M" + Point(at(0));
  for (std::size_t i = 0; i < n; ++i) {
    const auto [ax, ay] = at(i + n - 1);
    const auto [bx, by] = at(i);
    const auto [cx, cy] = at(i + 1);
    const auto [dx, dy] = at(i + 2);
    data += "C" + Point({bx + (cx - ax) / 6, by + (cy - ay) / 6}) + " " +
            Point({cx - (dx - bx) / 6, cy - (dy - by) / 6}) + " " + Point({cx, cy});
  }
  return "<path fill=\"none\" stroke=\"#c02020\" stroke-width=\"2.5\" d=\"" + data + "Z\"/>\n";
}

// Circles of 20 % less and more chroma, the sectors' limits and the reference.
std::string Background() {
  std::string svg;
  for (const double relative : {0.8, 0.9, 1.1, 1.2}) {
    svg += Circle(relative * kRadius, R"(stroke="#bbbbbb" stroke-dasharray="3 3")");
  }
  for (int i = 0; i < kHueBinCount; ++i) {
    const double angle = i * kBinTurn;
    svg += Line(R"(stroke="#dddddd")", {kCentre, kCentre},
                OnPage(1.35 * std::cos(angle), 1.35 * std::sin(angle)));
    const double middle = angle + kBinTurn / 2;
    PagePoint label = OnPage(1.43 * std::cos(middle), 1.43 * std::sin(middle));
    label.second += 4.0;
    svg += Label(label, "middle", 12, std::to_string(i + 1));
  }
  return svg + Circle(kRadius, R"(stroke="#222222" stroke-width="2")");
}

std::string ArrowMark(const Arrow& arrow) {
  const std::string color = BinColor(arrow.bin);
  const auto [x, y] = arrow.to;
  return Line("stroke=\"" + color + "\" stroke-width=\"3\"", arrow.from, arrow.to) +
         "<circle cx=\"" + Px(x) + "\" cy=\"" + Px(y) + "\" r=\"4\" fill=\"" + color + "\"/>\n";
}

}  // namespace

std::string ColorVectorGraphic(const ColorFidelity& fidelity, const GamutAndBins& gamut,
                               std::string_view title) {
  const std::vector<Arrow> arrows = ArrowsOf(gamut);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + Px(kSize) + " " +
                    Px(kSize) + "\" font-family=\"sans-serif\" role=\"img\">\n<title>" +
                    Escaped("Colour vector graphic of " + std::string(title)) +
                    "</title>\n<desc>ANSI/IES TM-30, written by lightcal: the reference light is "
                    "the circle, the light the curve.</desc>\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  svg += Background() + SmoothPath(arrows);
  for (const Arrow& arrow : arrows) svg += ArrowMark(arrow);
  svg += Label({16, 28}, "start", 18, "Rf " + Fixed(fidelity.Rf, 0));
  svg += Label({kSize - 16, 28}, "end", 18, "Rg " + Fixed(gamut.Rg, 0));
  svg += Label({kCentre, kSize - 8}, "middle", 12, title);
  return svg + "</svg>\n";
}

}  // namespace lightcal::report
