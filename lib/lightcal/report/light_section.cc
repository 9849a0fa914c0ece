// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/light_section.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/core/base64.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/stops.h"
#include "lightcal/records/used_readings.h"
#include "lightcal/report/plots.h"
#include "lightcal/report/swatch.h"
#include "lightcal/report/tables.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

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
  return html.empty() ? "" : "<dl class=\"cards below-first\">\n" + html + "</dl>\n";
}

std::string Title(const FittedLight& light) {
  const std::string swatch = SwatchOf(light.color).empty() ? "" : "<span class=\"swatch\"></span>";
  return "<div class=\"title\">" + swatch + "<h2>" + Escaped(light.name) +
         "</h2><span class=\"kind\">" + std::string(LightKindName(light.kind)) +
         " light</span></div>\n";
}

std::string StopsWords(double stops) {
  return "± " + RoundedText(stops, stops >= 0.0995 ? 2 : 1) + (stops <= 1.0 ? " stop" : " stops");
}

std::string Hero(const FittedLight& light) {
  const Headline headline = HeadlineOf(light);
  if (headline.value == nullptr) {
    return "<p class=\"soft\">No photometric figure was found for this light.</p>\n";
  }
  const Uncertain& u = *headline.value;
  const int decimals = u.u95 > 0.0 ? DecimalsFor(u.u95) : DecimalsFor(std::abs(u.value)) + 2;
  const auto stops = HalfWidthStops(u);
  std::string html = "<p class=\"hero\">" + Fixed(u.value, decimals) + " <span class=\"unit\">" +
                     headline.unit + "</span> <span class=\"pm\">" +
                     (stops && u.u95 > 0.0 ? StopsWords(*stops) : RelativePlusMinus(u)) +
                     "</span></p>\n";
  std::string line = Interval(u, headline.unit) + " · " + RelativePlusMinus(u) + " (95 %) · ";
  const std::string decided = DecidedBy(light.fit, "intensity");
  line += decided == "prior" ? "held by a prior" : "from";
  line += decided == "prior" ? "" : " " + UsedOfReadings(light.fit) + " readings";
  return html + "<p class=\"soft\">" + line + "</p>\n";
}

// ---- why it is no surer ----

struct PartOfBar {
  std::string_view css, words;
  double share = 0.0, sd = 0.0;
};

std::string PartsBar(const FittedLight& light) {
  if (light.budget.empty()) return "";
  std::array<PartOfBar, 4> parts = {{{"part-walls", "walls"},
                                     {"part-meter", "meter"},
                                     {"part-offset", "where the light starts"},
                                     {"part-other", "other"}}};
  for (const BudgetPart& part : light.budget) {
    const bool of_meter =
        part.name == "readings" || part.name == "meter_calibration" || part.name == kCameraScale;
    const std::size_t at = part.name == "room_bounce" || part.name == "shadow_card" ? 0
                           : of_meter                                               ? 1
                           : part.name == "distance_offset"                         ? 2
                                                                                    : 3;
    if (part.name == kCameraScale) parts[at].words = "camera and readings";
    parts[at].share += part.share;
    parts[at].sd = std::hypot(parts[at].sd, part.sd_relative);
  }
  constexpr double kLeastShown = 0.01;
  std::string bar;
  std::string legend;
  for (const PartOfBar& part : parts) {
    if (part.share < kLeastShown) continue;
    bar += "<span class=\"" + std::string(part.css) +
           "\" style=\"width:" + RoundedText(100.0 * part.share, 3) + "%\"></span>";
    legend += "<span><i class=\"" + std::string(part.css) + "\"></i>" + std::string(part.words) +
              " " + StopsWords(StopsOfSd(part.sd)) + "</span> ";
  }
  return "<div class=\"parts\" role=\"img\" aria-label=\"Where the uncertainty comes from\">" +
         bar + "</div><p class=\"legend soft\">" + legend + "</p>\n";
}

std::string Advice(const FittedLight& light, const ReportExtras& extras) {
  const auto found = std::ranges::find(extras.advice, light.name, &LightAdvice::light);
  if (found == extras.advice.end()) return "";
  return "<p class=\"advice\"><b>Enough for</b> " +
         Escaped(found->enough.empty() ? "nothing yet: look-dev asks for ± 0.5 stop"
                                       : found->enough) +
         "</p>\n<p class=\"advice\"><b>" + Escaped(found->label) + "</b> " + Escaped(found->text) +
         "</p>\n";
}

// The room's figure beside the answer, where readings have distances.
std::string FirstFigure(const FittedLight& light, const ReportExtras& extras,
                        const std::string& prefix) {
  const LightPlot& plot = LightPlots().front();
  const std::string svg = plot.draw(light, extras, prefix + std::string(plot.name));
  if (svg.empty()) return "";
  return "<figure class=\"first\">\n" + svg + "<figcaption>" +
         CaptionHtml(plot.caption(light, extras)) + "</figcaption>\n</figure>\n";
}

// Three numbers, or one of many digits.
constexpr std::size_t kLongValue = 11;

// The value is selected whole by one click, without a script.
std::string EngineCard(const EngineFigure& figure) {
  return "<li><h4>" + Escaped(figure.engine) + "</h4><p class=\"field\">" + Escaped(figure.field) +
         "</p><p class=\"number\"><span class=\"" +
         (figure.value.size() > kLongValue ? "copy long" : "copy") + "\">" + Escaped(figure.value) +
         "</span>" +
         (figure.unit.empty() ? "" : " <span class=\"unit\">" + Escaped(figure.unit) + "</span>") +
         "</p>" +
         (figure.note.empty() ? "" : "<p class=\"note\">" + Escaped(figure.note) + "</p>") +
         "</li>\n";
}

std::string TypeIn(const std::string& light, const std::vector<EngineFigure>& figures) {
  std::string cards;
  for (const EngineFigure& figure : figures) {
    if (figure.light == light) cards += EngineCard(figure);
  }
  if (cards.empty()) return "";
  return "<div class=\"below\"><h3>The number to type in</h3><ul class=\"engines\">\n" + cards +
         "</ul></div>\n";
}

std::string FigureBlock(const LightPlot& plot, const FittedLight& light, const ReportExtras& extras,
                        const std::string& prefix) {
  const std::string svg = plot.draw(light, extras, prefix + std::string(plot.name));
  if (svg.empty()) return "";
  return "<figure>\n<h3>" + std::string(plot.heading) + "</h3>\n" + svg + "<figcaption>" +
         CaptionHtml(plot.caption(light, extras)) + "</figcaption>\n</figure>\n";
}

// A picture of its own, as its rules are.
std::string CameraView(const FittedLight& light, const ReportExtras& extras) {
  const auto found = std::ranges::find(extras.matches, light.name, &LightMatchSheet::light);
  if (found == extras.matches.end()) return "";
  const MatchSheet& sheet = found->sheet;
  return "<figure class=\"sheet\">\n<h3>As " + Escaped(sheet.viewer) +
         " sees it</h3>\n<img alt=\"" + Escaped("Patches of colour: " + sheet.title) +
         "\" src=\"data:image/svg+xml;base64," + Base64(MatchSheetSvg(sheet)) + "\"/><figcaption>" +
         Escaped(sheet.lamp.title + ", " + sheet.target.title +
                 (sheet.has_gels ? ", and the first behind " + sheet.gelled.title : "")) +
         "</figcaption>\n</figure>\n";
}

std::string Figures(const FittedLight& light, const ReportExtras& extras,
                    const std::string& prefix) {
  std::string html;
  for (const LightPlot& plot : LightPlots().subspan(1)) {
    html += FigureBlock(plot, light, extras, prefix);
  }
  return "<div class=\"figures\">\n" + html + FitTable(light.fit) + "</div>\n";
}

std::string Below(const std::string& table) {
  return table.empty() ? "" : "<div class=\"below\">" + table + "</div>\n";
}

// By its own budget; of a distribution measured on a wall, of its flux too.
std::string WhereFrom(const FittedLight& light) {
  const bool of_wall = light.distribution && light.distribution->budget.size() > 1;
  return of_wall ? DistributionBudgetTable(light)
                 : BudgetTable(light.budget) + DistributionBudgetTable(light);
}

}  // namespace

Headline HeadlineOf(const FittedLight& light) {
  if (light.intensity_cd) return {&*light.intensity_cd, "cd"};
  if (light.illuminance_lx) return {&*light.illuminance_lx, "lx"};
  if (light.luminance_nits) return {&*light.luminance_nits, "cd/m²"};
  if (light.flux_lm) return {&*light.flux_lm, "lm"};
  return {};
}

std::string DecidedBy(const FitDiagnostics& fit, std::string_view parameter) {
  if (std::ranges::find(fit.learned, parameter) != fit.learned.end()) return "learned";
  if (std::ranges::find(fit.prior, parameter) != fit.prior.end()) return "prior";
  return "";
}

std::string LightSection(const FittedLight& light, int index, bool alone,
                         const ReportExtras& extras) {
  const std::string id = "light-" + std::to_string(index);
  const std::string swatch = SwatchOf(light.color);
  const std::string lamp = swatch.empty() ? "" : " style=\"--lamp:" + swatch + "\"";
  std::string html = std::string("<section class=\"light") +
                     (alone        ? " only"
                      : index == 0 ? " first"
                                   : "") +
                     "\" id=\"" + id + "\"" + lamp + ">\n<div class=\"summary\">\n<div>\n";
  const std::string figure = FirstFigure(light, extras, id + "-");
  html += Title(light) + Hero(light) + PartsBar(light) + Advice(light, extras) + "</div>\n" +
          (figure.empty() ? Cards(light) : figure) + "</div>\n";
  html += TypeIn(light.name, extras.engines.figures);
  if (!figure.empty()) html += Cards(light);
  html += Figures(light, extras, id + "-");
  html += Below(CameraView(light, extras));
  const std::string tables = Below(ReadingTable(light.residuals)) +
                             Below(ParityTable(light.name, extras.engines.parity)) +
                             Below(AroundTable(light.name, extras.engines.parity)) +
                             Below(WhereFrom(light)) + Below(EffectTable(light.effects));
  if (!tables.empty()) {
    html +=
        "<details class=\"rest\"><summary>Every reading, every engine's lux, every effect"
        "</summary>\n" +
        tables + "</details>\n";
  }
  return html + "</section>\n";
}

}  // namespace lightcal::report
