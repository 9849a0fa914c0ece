// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/page.h"

#include <algorithm>
#include <cmath>

#include "lightcal/records/used_readings.h"
#include "lightcal/report/gate_figure.h"
#include "lightcal/report/light_section.h"
#include "lightcal/report/style.h"
#include "lightcal/report/text.h"

namespace lightcal {
namespace {

using report::Escaped;

std::string Generator(const Provenance& provenance) {
  return provenance.generator.empty() ? "lightcal" : provenance.generator;
}

// "2026-05-01" of an ISO 8601 time.
std::string DateOf(const std::string& time) { return time.substr(0, time.find('T')); }

std::string Lead(const LightFile& file) {
  const std::size_t count = file.lights.size();
  std::string text = std::to_string(count) + (count == 1 ? " light" : " lights");
  if (!file.provenance.time.empty()) text += " · measured " + DateOf(file.provenance.time);
  return text + " · " + Generator(file.provenance);
}

std::string LabelledCell(std::string_view label, const std::string& html) {
  return "<td data-label=\"" + std::string(label) + "\">" + (html.empty() ? "—" : html) + "</td>";
}

std::string OverviewRow(const FittedLight& light, std::size_t index) {
  const report::Headline headline = report::HeadlineOf(light);
  std::string strength;
  if (headline.value != nullptr) {
    strength = report::PlusMinus(*headline.value, headline.unit);
  }
  const FittedColor& color = light.color;
  return "<tr><th scope=\"row\"><a href=\"#light-" + std::to_string(index) + "\">" +
         Escaped(light.name) + "</a></th>" + LabelledCell("strength (95 %)", strength) +
         LabelledCell("CCT", color.cct_K ? report::PlusMinus(*color.cct_K, "K") : "") +
         LabelledCell("Duv", color.duv ? report::PlusMinus(*color.duv, "") : "") +
         LabelledCell("d₀", light.distance_offset_m
                                ? report::PlusMinus(*light.distance_offset_m, "cm", 100.0)
                                : "") +
         LabelledCell("readings used", UsedOfReadings(light.fit)) +
         "</tr>\n";
}

std::string Overview(const LightFile& file) {
  if (file.lights.size() < 2) return "";
  std::string html =
      "<div class=\"overview\"><table><thead><tr><th scope=\"col\">light</th>"
      "<th scope=\"col\">strength (95 %)</th><th scope=\"col\">CCT</th><th scope=\"col\">Duv</th>"
      "<th scope=\"col\">d₀</th><th scope=\"col\">readings used</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < file.lights.size(); ++i) html += OverviewRow(file.lights[i], i);
  return html + "</tbody></table></div>\n";
}

std::string GateSection(const LightFile& file) {
  if (!report::HasEffects(file.lights)) return "";
  return "<section class=\"light\" id=\"gate\">\n<h2>What the effect gate saves</h2>\n"
         "<figure>\n<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Cost and "
         "error "
         "of the gate\">" +
         report::GateFigure(file.lights, report::kUsualTolerance, "gate-figure") +
         "</div><figcaption>Every effect a reading may hold has a price and a bound. The gate "
         "leaves "
         "effects off while all of them together stay within the tolerance, so that the cost "
         "follows the scene. Below the line the lights of this page: of what was left off only "
         "the bound is known.</figcaption>\n</figure>\n</section>\n";
}

std::string Footer(const Provenance& provenance) {
  std::string html =
      "<footer>\n<h3>How to read this</h3>\n"
      "<p class=\"small soft\">± is half the width of the 95 % interval. A facing meter at "
      "distance "
      "d from the reference point reads E = I / (d + d₀)² + E₀: I the luminous intensity on the "
      "axis, d₀ positive when the effective source lies behind the point the distance was measured "
      "from, E₀ the ambient light. Readings are numbered from 0. <em>Learned</em> means that the "
      "readings decided, <em>prior</em> that lightcal's expectation did.</p>\n"
      "<h3>Provenance</h3>\n<p class=\"small\">Written by " +
      Escaped(Generator(provenance)) + ".</p>\n";
  if (provenance.inputs.empty()) return html + "</footer>\n";
  html +=
      "<table><thead><tr><th scope=\"col\">input</th><th scope=\"col\">SHA-256</th></tr></thead>"
      "<tbody>\n";
  for (const InputFile& file : provenance.inputs) {
    html += "<tr><td><code>" + Escaped(file.path) + "</code></td><td><code>" +
            Escaped(file.sha256) + "</code></td></tr>\n";
  }
  return html + "</tbody></table>\n</footer>\n";
}

}  // namespace

std::string ReportPage(const LightFile& file, std::string_view title, const ReportExtras& extras) {
  const std::string name = Escaped(title);
  std::string html =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"generator\" content=\"" +
      Escaped(Generator(file.provenance)) + "\"/>\n<title>" + name +
      " · lightcal</title>\n<style>" + report::StyleSheet() +
      "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>" + name + "</h1>\n<p class=\"lead\">" +
      Escaped(Lead(file)) + "</p>\n</header>\n";
  html += Overview(file);
  for (std::size_t i = 0; i < file.lights.size(); ++i) {
    html +=
        report::LightSection(file.lights[i], static_cast<int>(i), file.lights.size() == 1, extras);
  }
  html += GateSection(file);
  return html + Footer(file.provenance) + "</main>\n</body>\n</html>\n";
}

}  // namespace lightcal
