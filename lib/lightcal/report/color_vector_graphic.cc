// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/color_vector_graphic.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kSize = 480.0;
constexpr double kCentre = kSize / 2.0;
constexpr double kRadius = 150.0;                   // of the reference circle
constexpr double kSectors = 1.36, kNumbers = 1.45;  // times kRadius
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

// A hue for each bin, red at the first, as bright on paper as on a dark screen.
std::string BinColor(std::size_t bin) {
  const double degrees = (static_cast<double>(bin) + 0.5) * 360.0 / kHueBinCount;
  return "hsl(" + Px(degrees) + ",62%,50%)";
}

std::string Point(PagePoint p) { return Px(p.first) + " " + Px(p.second); }

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
  return "<path class=\"gamut\" d=\"" + data + "Z\"/>";
}

// A pale sector of each hue, its number, circles of 10 and 20 % less and more chroma, and the
// reference.
void DrawBackground(Svg& svg) {
  for (std::size_t i = 0; i < kHueBinCount; ++i) {
    const double angle = static_cast<double>(i) * kBinTurn;
    const PagePoint from = OnPage(kSectors * std::cos(angle), kSectors * std::sin(angle));
    const PagePoint to =
        OnPage(kSectors * std::cos(angle + kBinTurn), kSectors * std::sin(angle + kBinTurn));
    const std::string arc = Px(kSectors * kRadius);
    svg.Element("<path class=\"hue\" fill=\"" + BinColor(i) + "\" d=\"M" + Px(kCentre) + " " +
                Px(kCentre) + "L" + Point(from) + "A" + arc + " " + arc + " 0 0 0 " + Point(to) +
                "Z\"/>");
    const double middle = angle + kBinTurn / 2;
    PagePoint label = OnPage(kNumbers * std::cos(middle), kNumbers * std::sin(middle));
    label.second += 4.5;
    svg.Text("tick", label, "middle", std::to_string(i + 1));
  }
  for (const double relative : {0.8, 0.9, 1.1, 1.2}) {
    svg.Circle("chroma", {kCentre, kCentre}, relative * kRadius);
  }
  svg.Circle("reference", {kCentre, kCentre}, kRadius);
}

void DrawArrow(Svg& svg, const Arrow& arrow) {
  svg.Line("shift", arrow.from, arrow.to);
  svg.Element("<circle class=\"shifted\" cx=\"" + Px(arrow.to.first) + "\" cy=\"" +
              Px(arrow.to.second) + "\" r=\"4.5\" fill=\"" + BinColor(arrow.bin) + "\"/>");
}

}  // namespace

std::string ColorVectorFigure(const ColorFidelity& fidelity, const GamutAndBins& gamut,
                              std::string_view title, std::string_view id) {
  const std::vector<Arrow> arrows = ArrowsOf(gamut);
  Svg svg(std::string(id), "Colour vector graphic of " + std::string(title),
          "ANSI/IES TM-30, written by lightcal: the reference light is the circle, the light the "
          "curve",
          {kSize, kSize});
  DrawBackground(svg);
  svg.Element(SmoothPath(arrows));
  for (const Arrow& arrow : arrows) DrawArrow(svg, arrow);
  svg.Text("score", {8.0, 26.0}, "start", "Rf " + Fixed(fidelity.Rf, 0));
  svg.Text("score", {kSize - 8.0, 26.0}, "end", "Rg " + Fixed(gamut.Rg, 0));
  return svg.Finish();
}

PlotCaption Tm30Caption() {
  return {{LineKey("reference", "reference light"),
           LineKey("gamut", "this light"),
           {"<path class=\"shift\" d=\"M2 6H16\"/>"
            "<circle class=\"used\" cx=\"17\" cy=\"6\" r=\"4\"/>",
            "shift of a hue"}},
          ""};
}

std::string ColorVectorGraphic(const ColorFidelity& fidelity, const GamutAndBins& gamut,
                               std::string_view title) {
  return StandaloneSvg(
      WithCaption(ColorVectorFigure(fidelity, gamut, title, "tm30"), Tm30Caption()));
}

}  // namespace lightcal::report
