// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/match_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/report/style.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/swatch.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kSheetWidth = 940.0;
constexpr double kSheetMargin = 28.0;
constexpr std::size_t kPatchColumns = 8;
constexpr double kPatchGap = 12.0;
constexpr double kPatchHeight = 74.0;
constexpr double kPatchPitch = 104.0;  // with the figure below
constexpr double kPatchesTop = 158.0;
constexpr std::size_t kPatchRows = 5;
constexpr double kSpectraHeight = 250.0;
constexpr Xy kScreenWhite = {0.312720, 0.329031};  // D65, CIE 15:2018 table 11.3

// White and skin first (samples 15 and 18 of CIE 224, then the older tables'), then as many others
// as fit, evenly along the circle of hues.
std::vector<std::size_t> ShownSamples() {
  std::vector<std::size_t> shown = {0, 15, 18, 100, 101};
  const std::size_t rest = kPatchRows * kPatchColumns - shown.size();
  for (std::size_t i = 0; i < rest; ++i) {
    const std::size_t sample = 2 + i * 98 / rest;
    shown.push_back(sample == 15 || sample == 18 ? sample + 1 : sample);
  }
  return shown;
}

std::string PatchName(std::size_t sample) {
  if (sample == 0) return "white";
  if (sample == 15 || sample == 18 || sample >= 100) return "skin";
  return "#" + std::to_string(sample);
}

constexpr std::string_view kSheetRules = R"css(
svg .heading { font-size: 20px; font-weight: 600; }
svg .column { font-size: 14px; font-weight: 600; }
svg .edge { fill: none; stroke: var(--rule); stroke-width: 1; }
svg .curve { fill: none; stroke-width: 2; stroke-linejoin: round; }
svg .of-lamp { stroke: #8a8f98; }
svg .of-target { stroke: var(--ink); stroke-dasharray: 6 4; }
svg .of-gelled { stroke: var(--warn); }
svg .of-gels { stroke: var(--accent); stroke-width: 1.5; }
)css";

void Stripe(Svg& svg, double left, double top, double width, const Xyz& color, Xy white) {
  const Xyz shown =
      AdaptBradford({color.X / 100.0, color.Y / 100.0, color.Z / 100.0}, white, kScreenWhite);
  svg.Element("<rect x=\"" + Px(left) + "\" y=\"" + Px(top) + "\" width=\"" + Px(width) +
              "\" height=\"" + Px(kPatchHeight) + "\" fill=\"" + HexOf(LinearSrgbFromXyz(shown)) +
              "\"/>");
}

void DrawPatches(Svg& svg, const MatchSheet& sheet) {
  const double pitch = (kSheetWidth - 2.0 * kSheetMargin + kPatchGap) / kPatchColumns;
  const double width = pitch - kPatchGap;
  const Xy white = XyFromXyz(sheet.target.samples.front());
  const std::vector<std::size_t> shown = ShownSamples();
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::size_t sample = shown[i];
    const double left = kSheetMargin + pitch * static_cast<double>(i % kPatchColumns);
    const double top = kPatchesTop + kPatchPitch * static_cast<double>(i / kPatchColumns);
    Stripe(svg, left, top, width / 3.0, sheet.lamp.samples[sample], white);
    Stripe(svg, left + width / 3.0, top, width / 3.0, sheet.target.samples[sample], white);
    if (sheet.has_gels) {
      Stripe(svg, left + 2.0 * width / 3.0, top, width / 3.0, sheet.gelled.samples[sample], white);
    }
    svg.Element("<rect class=\"edge\" x=\"" + Px(left) + "\" y=\"" + Px(top) + "\" width=\"" +
                Px(sheet.has_gels ? width : width * 2.0 / 3.0) + "\" height=\"" + Px(kPatchHeight) +
                "\"/>");
    const std::string before = Fixed(sheet.lamp.difference[sample], 1);
    svg.Text("tick", {left, top + kPatchHeight + 16.0}, "start", before);
    svg.Text("tick", {left + width / 2.0, top + kPatchHeight + 16.0}, "middle", PatchName(sample));
    if (sheet.has_gels) {
      svg.Text("tick", {left + width, top + kPatchHeight + 16.0}, "end",
               Fixed(sheet.gelled.difference[sample], 1));
    }
  }
}

std::vector<PagePoint> Curve(const Spectrum& spectrum, const Axis& x, const Axis& y) {
  double most = 0.0;
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    if (x.Holds(spectrum.wavelengths_nm[i])) most = std::max(most, spectrum.values[i]);
  }
  std::vector<PagePoint> points;
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    const double nm = spectrum.wavelengths_nm[i];
    if (!x.Holds(nm) || !(most > 0.0)) continue;
    points.emplace_back(x.At(nm), y.At(std::max(0.0, spectrum.values[i]) / most));
  }
  return points;
}

void DrawSpectra(Svg& svg, const MatchSheet& sheet, double top) {
  const Axis x{AxisScale::kLinear, 380.0, 780.0, kSheetMargin + 30.0, kSheetWidth - kSheetMargin};
  const Axis y{AxisScale::kLinear, 0.0, 1.0, top + kSpectraHeight, top};
  for (const double tick : TicksOf(x, 60.0)) {
    svg.Line("grid", {x.At(tick), top}, {x.At(tick), top + kSpectraHeight});
    svg.Text("tick", {x.At(tick), top + kSpectraHeight + 18.0}, "middle", Figure(tick));
  }
  for (const double tick : {0.0, 0.5, 1.0}) {
    svg.Line("grid", {x.from_px, y.At(tick)}, {x.to_px, y.At(tick)});
    svg.Text("tick", {x.from_px - 6.0, y.At(tick) + 4.0}, "end", Figure(tick));
  }
  svg.Path("curve of-lamp", Curve(sheet.lamp.spectrum, x, y));
  svg.Path("curve of-target", Curve(sheet.target.spectrum, x, y));
  if (sheet.has_gels) {
    svg.Path("curve of-gelled", Curve(sheet.gelled.spectrum, x, y));
    std::vector<PagePoint> gels;
    for (std::size_t k = 0; k < kNodeCount; ++k) {
      gels.emplace_back(x.At(NodeNm(k)), y.At(std::clamp(sheet.transmittance[k], 0.0, 1.0)));
    }
    svg.Path("curve of-gels", gels);
  }
  const double below = top + kSpectraHeight + 44.0;
  double left = kSheetMargin + 30.0;
  const auto key = [&](std::string_view css, std::string_view words) {
    svg.Line("curve " + std::string(css), {left, below - 4.0}, {left + 26.0, below - 4.0});
    svg.Text("tick", {left + 32.0, below}, "start", words);
    left += 52.0 + 7.2 * static_cast<double>(words.size());
  };
  key("of-lamp", "lamp");
  key("of-target", "target");
  if (!sheet.has_gels) return;
  key("of-gelled", "lamp behind the gels");
  key("of-gels", "what the gels let through");
}

}  // namespace

std::string MatchSheetSvg(const MatchSheet& sheet) {
  const double spectra = kPatchesTop + kPatchPitch * static_cast<double>(kPatchRows) + 16.0;
  const double height = spectra + kSpectraHeight + 64.0;
  Svg svg("match", sheet.title,
          "Patches of colour under the lamp, the target and the lamp behind gels, as " +
              sheet.viewer + " sees them; written by lightcal",
          {kSheetWidth, height});
  svg.Text("heading", {kSheetMargin, 38.0}, "start", sheet.title);
  svg.Text("note", {kSheetMargin, 60.0}, "start",
           "as " + sheet.viewer + " sees it, set to the target; in each patch, from the left:");
  svg.Text("column", {kSheetMargin, 86.0}, "start", "1 " + sheet.lamp.title);
  svg.Text("column", {kSheetMargin, 105.0}, "start", "2 " + sheet.target.title);
  if (sheet.has_gels) {
    svg.Text("column", {kSheetMargin, 124.0}, "start",
             "3 " + sheet.lamp.title + " behind " + sheet.gelled.title);
  }
  svg.Text("note", {kSheetMargin, 145.0}, "start",
           sheet.has_gels ? "Below each: ΔE of 1 and of 3 against 2; #: sample of CIE 224 (TM-30)"
                          : "Below each: ΔE of 1 against 2; #: sample of CIE 224 (TM-30)");
  DrawPatches(svg, sheet);
  DrawSpectra(svg, sheet, spectra);
  return StandaloneSvg(svg.Finish(), kSheetRules);
}

}  // namespace lightcal::report
