// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/light_section.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/tables.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

// IEC 61966-2-1 transfer function, 8 bit, two hex digits.
std::string EncodedHex(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  const auto code = static_cast<unsigned int>(std::lround(encoded * 255.0));
  constexpr std::string_view kHex = "0123456789abcdef";
  return {kHex[code >> 4U], kHex[code & 0xFU]};
}

std::string Card(std::string_view label, const std::string& value, const std::string& sub) {
  return "<div class=\"card\"><dt>" + Escaped(label) + "</dt><dd>" + value +
         (sub.empty() ? "" : "<span class=\"sub\">" + sub + "</span>") + "</dd></div>\n";
}

std::string Join(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

std::string OffsetCard(const FittedLight& light) {
  if (!light.distance_offset_m) return "";
  const Uncertain& d0 = *light.distance_offset_m;
  const char* side = d0.value > 0.0   ? "source lies behind the reference point"
                     : d0.value < 0.0 ? "source lies in front of the reference point"
                                      : "source lies at the reference point";
  return Card("Distance offset d₀", PlusMinus(d0, "cm", 100.0),
              Join(side, DecidedBy(light.fit, "distance_offset")));
}

std::string PositionCard(const FittedLight& light) {
  if (!light.position_m || !light.position_u95_m) return "";
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    const Uncertain along{(*light.position_m)[k], (*light.position_u95_m)[k], {}, {}};
    text += std::string(k == 0 ? "" : "<br>") + "xyz"[k] + " " + PlusMinus(along, "m");
  }
  return Card("Position found", text, "from the readings' own places");
}

std::string ColorCards(const FittedColor& color) {
  std::string html;
  if (color.cct_K) {
    html += Card("Colour temperature (CCT)", PlusMinus(*color.cct_K, "K"),
                 Fixed(1e6 / color.cct_K->value, 1) + " mired");
  }
  if (color.duv) {
    const bool on_locus = std::abs(color.duv->value) <= color.duv->u95;
    const char* tint = on_locus                 ? "on the Planckian locus within its uncertainty"
                       : color.duv->value > 0.0 ? "above the Planckian locus: greenish"
                                                : "below the Planckian locus: pinkish";
    html += Card("Duv", PlusMinus(*color.duv, ""), tint);
  }
  if (color.xy) {
    html += Card("Chromaticity x, y", Fixed(color.xy->x, 4) + ", " + Fixed(color.xy->y, 4), "");
  }
  return html;
}

std::string PhotometryCard(std::string_view label, const std::optional<Uncertain>& value,
                           const char* unit, const Headline& headline) {
  if (!value || headline.value == &*value) return "";
  return Card(label, PlusMinus(*value, unit), RelativePlusMinus(*value));
}

std::string Cards(const FittedLight& light) {
  const Headline headline = HeadlineOf(light);
  std::string html = ColorCards(light.color);
  html += PhotometryCard("Luminous flux", light.flux_lm, "lm", headline);
  html += PhotometryCard("Illuminance", light.illuminance_lx, "lx", headline);
  html += PhotometryCard("Luminance", light.luminance_nits, "cd/m²", headline);
  html += OffsetCard(light);
  html += PositionCard(light);
  if (light.ambient_lx && (light.ambient_lx->value != 0.0 || light.ambient_lx->u95 > 0.0)) {
    html +=
        Card("Ambient light", PlusMinus(*light.ambient_lx, "lx"), DecidedBy(light.fit, "ambient"));
  }
  if (light.outer_deg) {
    html += Card(
        "Cone, half angles",
        (light.inner_deg ? Figure(*light.inner_deg) + "° … " : "") + Figure(*light.outer_deg) + "°",
        light.inner_deg ? "inner … outer" : "outer");
  }
  return html.empty() ? "" : "<dl class=\"cards\">\n" + html + "</dl>\n";
}

std::string Title(const FittedLight& light) {
  const std::string swatch = SwatchOf(light.color);
  std::string html = "<div class=\"title\">";
  if (!swatch.empty()) {
    html += "<span class=\"swatch\" style=\"background:" + swatch + "\"></span>";
  }
  return html + "<h2>" + Escaped(light.name) + "</h2><span class=\"kind\">" +
         std::string(LightKindName(light.kind)) + " light</span></div>\n";
}

std::string Hero(const FittedLight& light) {
  const Headline headline = HeadlineOf(light);
  if (headline.value == nullptr) {
    return "<p class=\"soft\">No photometric figure was found for this light.</p>\n";
  }
  const Uncertain& u = *headline.value;
  const int decimals = u.u95 > 0.0 ? DecimalsFor(u.u95) : DecimalsFor(std::abs(u.value)) + 2;
  std::string html = "<p class=\"hero\">" + Fixed(u.value, decimals) + " <span class=\"unit\">" +
                     headline.unit + "</span> <span class=\"pm\">" + RelativePlusMinus(u) +
                     "</span></p>\n";
  std::string line = "95 % interval " + Interval(u, headline.unit) + " · ";
  const std::string decided = DecidedBy(light.fit, "intensity");
  line += decided == "prior" ? "held by a prior" : "from";
  line += decided == "prior" ? ""
                             : " " + std::to_string(light.fit.used) + " of " +
                                   std::to_string(light.fit.readings) + " readings";
  return html + "<p class=\"soft\">" + line + "</p>\n";
}

std::string TypeIn(const std::string& light, const std::vector<EngineFigure>& figures) {
  std::string rows;
  for (const EngineFigure& figure : figures) {
    if (figure.light != light) continue;
    rows += "<tr><th scope=\"row\">" + Escaped(figure.engine) + "</th><td>" +
            Escaped(figure.field) + "</td><td class=\"value\">" + Escaped(figure.value) +
            "</td><td class=\"soft note\">" + Escaped(figure.note) + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<div class=\"block below\"><h3>The number to type in</h3>"
         "<div class=\"scroll\"><table class=\"typein\"><tbody>\n" +
         rows + "</tbody></table></div></div>\n";
}

std::string Key(std::string_view mark, std::string_view label) {
  return "<span class=\"key\"><svg viewBox=\"0 0 22 12\" aria-hidden=\"true\">" +
         std::string(mark) + "</svg>" + std::string(label) + "</span>";
}

std::string FigureBlock(const std::string& svg, std::string_view heading,
                        const std::string& caption) {
  if (svg.empty()) return "";
  return "<figure>\n<h3>" + std::string(heading) + "</h3>\n" + svg + "<figcaption>" + caption +
         "</figcaption>\n</figure>\n";
}

std::string ReadingKeys(const FittedLight& light) {
  const bool rejected =
      std::ranges::any_of(light.residuals, [](const ResidualRow& row) { return !row.used; });
  return Key("<line class=\"whisker\" x1=\"11\" y1=\"0\" x2=\"11\" y2=\"12\"/>"
             "<circle class=\"used\" cx=\"11\" cy=\"6\" r=\"4\"/>",
             "reading with its 95 %") +
         (rejected ? Key("<path class=\"rejected\" d=\"M7 2L15 10M7 10L15 2\"/>", "rejected") : "");
}

std::string Figures(const FittedLight& light, const std::string& prefix) {
  const std::string model =
      Key("<line class=\"model\" x1=\"0\" y1=\"6\" x2=\"22\" y2=\"6\"/>", "model");
  const std::string band =
      Key("<rect class=\"band\" x=\"0\" y=\"1\" width=\"22\" height=\"10\"/>", "its 95 % band");
  std::string html =
      FigureBlock(DistanceFigure(light, prefix + "distance"), "Illuminance against distance",
                  ReadingKeys(light) + model + (light.covariance_lnI_d0_E0 ? band : ""));
  html += FigureBlock(ResidualFigure(light, prefix + "residual"), "Distance from the model",
                      ReadingKeys(light));
  html += FigureBlock(PolarFigure(light, prefix + "polar"), "Intensity by direction", "");
  html += FigureBlock(
      ChromaticityFigure(light, prefix + "chromaticity"), "Chromaticity, CIE 1976 u′v′",
      Key("<circle class=\"used\" cx=\"11\" cy=\"6\" r=\"4\"/>", "light") +
          (light.color.cct_K ? Key("<ellipse class=\"ellipse\" cx=\"11\" cy=\"6\" rx=\"9\" "
                                   "ry=\"5\"/>",
                                   "its 95 % region")
                             : "") +
          Key("<line class=\"locus\" x1=\"0\" y1=\"6\" x2=\"22\" y2=\"6\"/>", "Planckian locus") +
          Key("<line class=\"guide\" x1=\"0\" y1=\"6\" x2=\"22\" y2=\"6\"/>", "Duv ±0.006"));
  return "<div class=\"figures\">\n" + html + FitTable(light.fit) + "</div>\n";
}

std::string Below(const std::string& table) {
  return table.empty() ? "" : "<div class=\"below\">" + table + "</div>\n";
}

}  // namespace

Headline HeadlineOf(const FittedLight& light) {
  if (light.intensity_cd) return {&*light.intensity_cd, "cd"};
  if (light.illuminance_lx) return {&*light.illuminance_lx, "lx"};
  if (light.luminance_nits) return {&*light.luminance_nits, "cd/m²"};
  if (light.flux_lm) return {&*light.flux_lm, "lm"};
  return {};
}

std::string SwatchOf(const FittedColor& color) {
  std::optional<Xy> xy = color.xy;
  if (!xy && color.cct_K && color.cct_K->value > 0.0) {
    xy = XyFromCct(Kelvin(color.cct_K->value), color.duv ? color.duv->value : 0.0);
  }
  if (!xy || !(xy->y > 0.0)) return "";
  const Rgb c = LinearRgbFromXyz(XyzFromXyAtUnitY(*xy), RgbSpace::kSrgb);
  const double largest = std::max({c.r, c.g, c.b});
  return "#" + EncodedHex(c.r / largest) + EncodedHex(c.g / largest) + EncodedHex(c.b / largest);
}

std::string DecidedBy(const FitDiagnostics& fit, std::string_view parameter) {
  if (std::ranges::find(fit.learned, parameter) != fit.learned.end()) return "learned";
  if (std::ranges::find(fit.prior, parameter) != fit.prior.end()) return "prior";
  return "";
}

std::string LightSection(const FittedLight& light, int index, bool alone,
                         const std::vector<EngineFigure>& figures) {
  const std::string prefix = "light-" + std::to_string(index) + "-";
  std::string html = std::string("<section class=\"light") + (alone ? " only" : "") +
                     "\" id=\"light-" + std::to_string(index) + "\">\n";
  html += Title(light) + Hero(light) + Cards(light) + TypeIn(light.name, figures);
  html += Figures(light, prefix);
  html += Below(ReadingTable(light.residuals)) + Below(BudgetTable(light.budget)) +
          Below(EffectTable(light.effects));
  return html + "</section>\n";
}

}  // namespace lightcal::report
