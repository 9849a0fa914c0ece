// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/core/numbers_text.h"
#include "lightcal/report/light_section.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/swatch.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

using std::numbers::pi;

constexpr PagePoint kTile = {340.0, 178.0};
constexpr double kTileGap = 16.0;
constexpr double kMargin = 24.0;
constexpr double kHeading = 40.0;
constexpr std::size_t kColumns = 3;
constexpr double kTextLeft = 18.0;  // of a tile's text
constexpr std::size_t kLongestName = 21;
constexpr std::size_t kLongestNote = 34;

constexpr std::string_view kRules = R"css(
svg .tile { fill: var(--panel); stroke: var(--rule); stroke-width: 1; }
svg .heading { font-size: 20px; font-weight: 600; }
svg .name { font-size: 15.5px; font-weight: 600; }
svg .big { font-size: 25px; font-weight: 650; letter-spacing: -.01em; }
svg .figure { font-size: 13px; }
svg .lobe { stroke: var(--ink); stroke-width: 1.4; stroke-linejoin: round; }
svg .ray { stroke: var(--ink); stroke-width: 1.4; fill: none; }
svg .swatch-ring { fill: none; stroke: var(--rule); stroke-width: 1; }
)css";

constexpr std::string_view kPageRules = R"css(
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 300px), 1fr)); gap: 16px; margin-top: 28px; }
.sheet svg { max-width: none; }
@media print { .sheet { grid-template-columns: repeat(2, 1fr); } .sheet svg { break-inside: avoid; } }
)css";

// At most so many characters, an ellipsis for the rest.
std::string Shortened(std::string_view text, std::size_t most) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (starts && characters++ == most) return std::string(text.substr(0, i)) + "…";
  }
  return std::string(text);
}

void DrawSwatch(Svg& svg, const std::string& color) {
  const PagePoint at = {kTextLeft + 11.0, 31.0};
  if (!color.empty()) {
    svg.Element("<circle cx=\"" + Px(at.first) + "\" cy=\"" + Px(at.second) +
                "\" r=\"11\" fill=\"" + color + "\"/>");
  }
  svg.Circle("swatch-ring", at, 11.0, color.empty() ? "colour unknown" : "");
}

// Where the small plot stands: around the lamp, or only below it.
struct Polar {
  PagePoint centre{264.0, 54.0};
  double radius = 68.0;
  double most = 0.5 * pi;  // the largest angle from straight down that is drawn

  [[nodiscard]] PagePoint At(double part, double out) const {
    return {centre.first + part * radius * std::sin(out),
            centre.second + part * radius * std::cos(out)};
  }
};

constexpr int kLobeSteps = 72;  // each way from straight down

std::vector<PagePoint> Arc(const Polar& polar, double part) {
  std::vector<PagePoint> points;
  for (int i = -kLobeSteps; i <= kLobeSteps; ++i)
    points.push_back(polar.At(part, polar.most * i / kLobeSteps));
  return points;
}

bool ShinesUp(const IntensityTable& table) {
  constexpr double kVisible = 0.005;  // of the peak
  for (int i = 1; i <= kLobeSteps; ++i) {
    const Radians gamma(0.5 * pi * (1.0 + static_cast<double>(i) / kLobeSteps));
    for (const double c : {0.0, pi}) {
      const double candela = table.At(Radians(c), gamma).value();
      if (candela > kVisible * table.peak().intensity.value()) return true;
    }
  }
  return false;
}

void DrawLobe(Svg& svg, const IntensityTable& table, const std::string& color) {
  Polar polar;
  if (ShinesUp(table)) polar = {{270.0, 89.0}, 58.0, pi};
  for (const double part : {0.5, 1.0}) svg.Path("ring", Arc(polar, part));
  svg.Line("ring", polar.At(1.0, -0.5 * pi), polar.At(1.0, 0.5 * pi));
  svg.Line("ring", polar.centre, polar.At(1.0, 0.0));
  const double peak = table.peak().intensity.value();
  std::string data;
  for (int i = -kLobeSteps; i <= kLobeSteps; ++i) {
    const double out = polar.most * i / kLobeSteps;
    const double candela = table.At(Radians(out < 0.0 ? pi : 0.0), Radians(std::abs(out))).value();
    const PagePoint at = polar.At(candela / peak, out);
    data += (data.empty() ? "M" : "L") + Px(at.first) + " " + Px(at.second);
  }
  svg.Element("<path class=\"lobe\" d=\"" + data + "Z\" fill=\"" +
              (color.empty() ? "none" : color) + "\" fill-opacity=\".55\"/>");
}

void DrawRays(Svg& svg) {
  for (const double x : {238.0, 270.0, 302.0}) {
    svg.Path("ray", {{x, 44.0}, {x, 132.0}});
    svg.Path("ray", {{x - 5.0, 123.0}, {x, 132.0}, {x + 5.0, 123.0}});
  }
}

void DrawShape(Svg& svg, const SheetLight& entry, const std::string& color) {
  if (entry.distribution) {
    DrawLobe(svg, *entry.distribution, color);
  } else if (entry.light.kind == LightKind::kDirectional) {
    DrawRays(svg);
  } else if (entry.light.kind == LightKind::kSpot) {
    svg.Text("note", {270.0, 84.0}, "middle", "beam not");
    svg.Text("note", {270.0, 101.0}, "middle", "measured");
  } else if (entry.light.kind == LightKind::kDome) {
    std::vector<PagePoint> dome;
    for (int i = 0; i <= kLobeSteps; ++i) {
      const double a = pi * i / kLobeSteps;
      dome.emplace_back(270.0 - 58.0 * std::cos(a), 118.0 - 58.0 * std::sin(a));
    }
    svg.Path("ray", dome, true);
  }
}

// Of a lamp with controls, over all states that were read: "10 … 101 % by its controls".
std::string OutputRange(const FittedLight& light) {
  double least = light.states.front().relative.value;
  double most = least;
  for (const MeasuredState& state : light.states) {
    least = std::min(least, state.relative.value);
    most = std::max(most, state.relative.value);
  }
  return RoundedText(100.0 * least, 2) + " … " + RoundedText(100.0 * most, 3) +
         " % by its controls";
}

// "2940 … 5500 K" where its controls change the colour, else its one colour temperature.
std::string TemperatureRange(const FittedLight& light) {
  constexpr double kSameColor = 0.02;
  if (!light.color.cct_K) return "no colour temperature";
  double least = light.color.cct_K->value;
  double most = least;
  for (const MeasuredState& state : light.states) {
    if (!state.color.cct_K) continue;
    least = std::min(least, state.color.cct_K->value);
    most = std::max(most, state.color.cct_K->value);
  }
  if (most <= least * (1.0 + kSameColor)) return PlusMinus(*light.color.cct_K, "K");
  return RoundedText(least, 3) + " … " + RoundedText(most, 3) + " K";
}

void DrawTile(Svg& svg, const SheetLight& entry) {
  const FittedLight& light = entry.light;
  const std::string color = SwatchOf(light.color);
  svg.Element("<rect class=\"tile\" x=\".5\" y=\".5\" width=\"" + Px(kTile.first - 1.0) +
              "\" height=\"" + Px(kTile.second - 1.0) + "\" rx=\"10\"/>");
  DrawShape(svg, entry, color);
  DrawSwatch(svg, color);
  svg.Text("name", {kTextLeft + 32.0, 29.0}, "start", Shortened(light.name, kLongestName));
  svg.Text("note", {kTextLeft + 32.0, 45.0}, "start", LightKindName(light.kind));
  const Headline headline = HeadlineOf(light);
  if (headline.value != nullptr) {
    const Uncertain bare{headline.value->value, 0.0, {}, {}};
    svg.Text("big", {kTextLeft, 84.0}, "start", PlusMinus(bare, headline.unit));
    svg.Text("note", {kTextLeft, 101.0}, "start", RelativePlusMinus(*headline.value));
  }
  if (light.states.size() > 1) {
    svg.Text("figure", {kTextLeft, 124.0}, "start", OutputRange(light));
  } else if (light.flux_lm && headline.value != &*light.flux_lm) {
    svg.Text("figure", {kTextLeft, 124.0}, "start",
             PlusMinus(Uncertain{light.flux_lm->value, 0.0, {}, {}}, "lm") + " " +
                 RelativePlusMinus(*light.flux_lm));
  }
  svg.Text("figure", {kTextLeft, 143.0}, "start", TemperatureRange(light));
  svg.Text("note", {kTextLeft, 165.0}, "start", Shortened(entry.note, kLongestNote));
}

std::string CountOf(const std::vector<SheetLight>& lights) {
  return std::to_string(lights.size()) + (lights.size() == 1 ? " light" : " lights");
}

}  // namespace

std::string ContactSheetSvg(const std::vector<SheetLight>& lights, std::string_view title) {
  const std::size_t columns = std::clamp<std::size_t>(lights.size(), 1, kColumns);
  const std::size_t rows = (lights.size() + columns - 1) / columns;
  const auto extent = [](std::size_t count, double side) {
    return 2.0 * kMargin + static_cast<double>(count) * (side + kTileGap) - kTileGap;
  };
  Svg svg("sheet", title, "Contact sheet of " + CountOf(lights) + ", written by lightcal",
          {extent(columns, kTile.first),
           extent(std::max<std::size_t>(rows, 1), kTile.second) + kHeading});
  svg.Text("heading", {kMargin, kMargin + 18.0}, "start", title);
  svg.Text("note", {extent(columns, kTile.first) - kMargin, kMargin + 18.0}, "end",
           CountOf(lights));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double x = kMargin + static_cast<double>(i % columns) * (kTile.first + kTileGap);
    const double y =
        kMargin + kHeading + static_cast<double>(i / columns) * (kTile.second + kTileGap);
    svg.Element("<g transform=\"translate(" + Px(x) + " " + Px(y) + ")\">");
    DrawTile(svg, lights[i]);
    svg.Element("</g>");
  }
  return StandaloneSvg(svg.Finish(), kRules);
}

std::string ContactSheetPage(const std::vector<SheetLight>& lights, std::string_view title) {
  const std::string name = Escaped(title);
  std::string html =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"generator\" content=\"lightcal\"/>\n<title>" +
      name + " · lightcal</title>\n<style>" + std::string(StyleSheet()) + std::string(kRules) +
      std::string(kPageRules) + "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>" + name +
      "</h1>\n<p class=\"lead\">" + CountOf(lights) +
      " · ± is half the width of the 95 % interval</p>\n</header>\n<div class=\"sheet\">\n";
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Svg svg("light-" + std::to_string(i), lights[i].light.name,
            "Colour, strength and shape of a light", kTile);
    DrawTile(svg, lights[i]);
    html += svg.Finish();
  }
  return html + "</div>\n</main>\n</body>\n</html>\n";
}

}  // namespace lightcal::report
