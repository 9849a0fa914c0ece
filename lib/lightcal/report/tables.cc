// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/tables.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/used_readings.h"
#include "lightcal/report/svg.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

// Parts of less than a thousandth change nothing.
constexpr double kLeastShareShown = 1e-3;

std::string Words(const std::string& name) {
  std::string words = name;
  std::ranges::replace(words, '_', ' ');
  return Escaped(words);
}

std::string List(const std::vector<std::string>& names) {
  return names.empty() ? "—" : Joined(names, ", ", Words);
}

std::string Numbers(const std::vector<int>& numbers) {
  return Joined(numbers, ", ", [](int n) { return std::to_string(n); });
}

std::string Cell(std::string_view html, bool number = false) {
  return std::string(number ? "<td class=\"n\">" : "<td>") + std::string(html) + "</td>";
}

// Illuminance with the digits a meter shows.
std::string Illuminance(double lux) {
  return Figure(lux == 0.0 ? 0.0 : ParseNumber(RoundedText(lux, 4)).value_or(lux));
}

// 100 px for all of it.
std::string Bar(double part) {
  return "<span class=\"share\" style=\"width:" + Px(100.0 * part) + "px\"></span>";
}

// What rounds to nothing has no sign.
std::string Residual(double relative) {
  constexpr double kNothing = 5e-5;
  return std::abs(relative) < kNothing ? "0.00\u00A0%" : SignedPercent(relative);
}

// Nobody ran it: what its law makes of our own numbers is no measurement.
std::string OffBy(const ParityRow& row) {
  constexpr double kNothing = 5e-5;
  const double relative = row.engine_lx / row.expected_lx - 1.0;
  if (row.rendered) return Residual(relative);
  const std::string by = "<span class=\"notrun\">by its published law, not run</span>";
  return std::abs(relative) < kNothing ? by : SignedPercent(relative) + " " + by;
}

const char* StateWord(EffectState state) {
  switch (state) {
    case EffectState::kOff:
      return "off";
    case EffectState::kOn:
      return "on";
    case EffectState::kFitted:
      return "fitted";
  }
  return "";
}

}  // namespace

std::string PairTable(std::string_view heading,
                      const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string html = "<div class=\"block\"><h3>" + Escaped(heading) + "</h3><table><tbody>\n";
  for (const auto& [label, value] : rows) {
    html += "<tr><th scope=\"row\">" + Escaped(label) + "</th>" + Cell(value) + "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string FitTable(const FitDiagnostics& fit) {
  std::vector<std::pair<std::string, std::string>> rows = {{"Readings used", UsedOfReadings(fit)}};
  if (!fit.rejected.empty()) {
    rows.emplace_back("Rejected", "<span class=\"off\">no. " + Numbers(fit.rejected) + "</span>");
  }
  rows.emplace_back("Degrees of freedom", std::to_string(fit.degrees_of_freedom));
  rows.emplace_back("Residual rms", fit.rms_relative ? Percent(fit.rms_relative)
                                                     : "not claimed: no degree of freedom left");
  rows.emplace_back("Leave-one-out error", Percent(fit.leave_one_out));
  if (fit.chi2_dof) rows.emplace_back("χ² per degree of freedom", RoundedText(*fit.chi2_dof, 3));
  if (fit.condition) rows.emplace_back("Condition number", RoundedText(*fit.condition, 3));
  rows.emplace_back("Learned from the readings", List(fit.learned));
  rows.emplace_back("Held by a prior", List(fit.prior));
  return PairTable("How sure, and why", rows);
}

std::string ReadingTable(const std::vector<ResidualRow>& rows) {
  if (rows.empty()) return "";
  std::string html =
      "<div class=\"block\"><h3>Readings against the model</h3><table class=\"readings\"><thead>"
      "<tr><th class=\"n\" scope=\"col\">no.</th><th class=\"n\" scope=\"col\">distance</th>"
      "<th class=\"n\" scope=\"col\">measured</th><th class=\"n\" scope=\"col\">model</th>"
      "<th class=\"n\" scope=\"col\">residual</th></tr></thead><tbody>\n";
  for (const ResidualRow& row : rows) {
    const std::string residual = SignedPercent(row.relative);
    html +=
        "<tr>" + Cell(std::to_string(row.index), true) +
        Cell(row.distance_m ? Figure(*row.distance_m) + "\u00A0m" : "—", true) +
        Cell(Illuminance(row.measured_lx) + "\u00A0lx", true) +
        Cell(Illuminance(row.predicted_lx) + "\u00A0lx", true) +
        Cell(row.used ? residual : "<span class=\"off\">" + residual + " rejected</span>", true) +
        "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// A dome's picture six ways, where the pictures were given.
std::string AroundTable(std::string_view light, const std::vector<ParityRow>& rows) {
  std::string head, expected, body;
  for (const ParityRow& row : rows) {
    if (row.light != light || row.around.empty()) continue;
    const bool first = body.empty();
    body += "<tr><th scope=\"row\">" + Escaped(row.engine) + "</th>";
    for (const WayLux& way : row.around) {
      const std::string word(way.way);
      if (first) {
        head += "<th class=\"n\" scope=\"col\">" + word + "</th>";
        expected += "<td class=\"n\" data-label=\"" + word + " \">" + Illuminance(way.expected_lx) +
                    "\u00A0lx</td>";
      }
      body += "<td class=\"n\" data-label=\"" + word + " \">" +
              Residual(way.engine_lx / way.expected_lx - 1.0) + "</td>";
    }
    body += "<td data-label=\"law \">" + Escaped(row.law) +
            (row.rendered ? "" : ", <span class=\"notrun\">by its published law, not run</span>") +
            "</td></tr>\n";
  }
  if (body.empty()) return "";
  return "<div class=\"block\"><h3>The place in every engine, six ways</h3><p class=\"small "
         "soft\">A "
         "white card that faces each way under the picture alone, and how far off it each engine "
         "is: "
         "those that keep nine harmonics of it cannot hold a sun, which is better taken out as a "
         "lamp.</p><table class=\"stack parity\"><thead><tr><th scope=\"col\">a card facing</th>" +
         head +
         "<th scope=\"col\">by</th></tr></thead><tbody>\n<tr><th scope=\"row\">the picture</th>" +
         expected + "<td>its own integral</td></tr>\n" + body + "</tbody></table></div>\n";
}

std::string ParityTable(std::string_view light, const std::vector<ParityRow>& rows) {
  std::string body;
  const ParityRow* any = nullptr;
  const bool beam = std::ranges::any_of(
      rows, [&](const ParityRow& row) { return row.light == light && row.off_axis.has_value(); });
  for (const ParityRow& row : rows) {
    if (row.light != light) continue;
    any = &row;
    const std::string off_axis =
        row.off_axis ? "within " + Percent(*row.off_axis) +
                           (*row.off_axis > 0.0 ? " (" + Figure(row.off_axis_deg) + "°)" : "")
                     : "—";
    body += "<tr><th scope=\"row\">" + Escaped(row.engine) +
            "</th><td class=\"n\" data-label=\"gives \">" + Illuminance(row.engine_lx) +
            "\u00A0lx</td><td class=\"n\" data-label=\"off by \">" + OffBy(row) + "</td>" +
            (beam ? "<td class=\"n\" data-label=\"off the axis \">" + off_axis + "</td>" : "") +
            "<td data-label=\"law \">" + Escaped(row.law) + "</td><td class=\"note\"><span " +
            "class=\"" + (row.rendered ? "ran" : "notran") + "\">" + Escaped(row.executed) +
            "</span></td></tr>\n";
  }
  if (any == nullptr) return "";
  const std::string where = any->distance_m > 0.0
                                ? "At " + Figure(any->distance_m) + "\u00A0m the lamp gives "
                                : "Facing it, the lamp gives ";
  return "<div class=\"block\"><h3>The same lux in every engine</h3><p class=\"small soft\">" +
         where + Illuminance(any->expected_lx) +
         "\u00A0lx without ambient light. What the numbers above give there by each engine’s own "
         "law:</p><table class=\"stack parity\"><thead><tr><th scope=\"col\">engine</th>"
         "<th class=\"n\" scope=\"col\">gives</th><th class=\"n\" scope=\"col\">off by</th>" +
         (beam ? "<th class=\"n\" scope=\"col\">off the axis, of the axial value</th>" : "") +
         "<th scope=\"col\">its falloff</th><th scope=\"col\">how its exporter was "
         "checked</th></tr></thead><tbody>\n" +
         body + "</tbody></table></div>\n";
}

std::string BudgetTable(const std::vector<BudgetPart>& budget) {
  if (budget.empty()) return "";
  std::string html =
      "<div class=\"block\"><h3>Where the uncertainty comes from</h3><table "
      "class=\"stack\"><thead><tr><th scope=\"col\">cause</th>"
      "<th class=\"n\" scope=\"col\">alone (1 σ)</th>"
      "<th class=\"n\" scope=\"col\">share of u²</th><td></td>"
      "<th scope=\"col\">what would halve it</th></tr></thead><tbody>\n";
  for (const BudgetPart& part : budget) {
    if (part.share < kLeastShareShown) continue;
    html += "<tr><th scope=\"row\">" + Words(part.name) +
            "</th><td class=\"n\" data-label=\"alone \">" + Percent(part.sd_relative) +
            "</td><td class=\"n\" data-label=\"share \">" + Percent(part.share) + "</td><td>" +
            Bar(part.share) + "</td><td class=\"note\">" + Escaped(part.halve) + "</td></tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string DistributionBudgetTable(const FittedLight& light) {
  if (!light.distribution || light.distribution->budget.empty()) return "";
  double most = 0.0;
  for (const auto& part : light.distribution->budget) most = std::max(most, part.peak);
  std::string html =
      "<div class=\"block\"><h3>Where the uncertainty comes from</h3><table class=\"stack\"><thead>"
      "<tr><th scope=\"col\">cause</th><th class=\"n\" scope=\"col\">of the peak (1 σ)</th>"
      "<th class=\"n\" scope=\"col\">of the flux (1 σ)</th><td></td></tr></thead><tbody>\n";
  for (const auto& part : light.distribution->budget) {
    html += "<tr><th scope=\"row\">" + Words(part.name) +
            "</th><td class=\"n\" data-label=\"peak \">" + Percent(part.peak) +
            "</td><td class=\"n\" data-label=\"flux \">" + Percent(part.flux) + "</td><td>" +
            Bar(most > 0.0 ? part.peak / most : 0.0) + "</td></tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string EffectTable(const std::vector<EffectReport>& effects) {
  if (effects.empty()) return "";
  std::string html =
      "<div class=\"block\"><h3>Effects considered</h3><table "
      "class=\"stack effects\"><thead><tr>"
      "<th scope=\"col\">effect</th><th scope=\"col\">state</th>"
      "<th class=\"n\" scope=\"col\">at most</th><th class=\"n\" scope=\"col\">found</th>"
      "<th class=\"n\" scope=\"col\">cost</th><th scope=\"col\">why</th></tr></thead><tbody>\n";
  for (const EffectReport& effect : effects) {
    html += "<tr><th scope=\"row\">" + Words(effect.name) + "</th>" +
            Cell(StateWord(effect.state)) + "<td class=\"n\" data-label=\"at most \">" +
            Percent(effect.bound) + "</td>" + "<td class=\"n\" data-label=\"found \">" +
            Percent(effect.contribution) + "</td>" + "<td class=\"n\" data-label=\"cost \">" +
            RoundedText(effect.cost_ns, 3) + "\u00A0ns</td><td class=\"note\">" +
            Escaped(effect.reason) + "</td></tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace lightcal::report
