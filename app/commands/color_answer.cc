// SPDX-License-Identifier: Apache-2.0
#include "color_answer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "color_spaces.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

std::string_view StatusWord(CctStatus status) {
  switch (status) {
    case CctStatus::kOk:
      return "ok";
    case CctStatus::kFarFromLocus:
      return "far_from_locus";
    case CctStatus::kBelowRange:
      return "below_1000_K";
    case CctStatus::kBeyondInfinity:
      return "beyond_infinity";
    case CctStatus::kNotAChromaticity:
      break;
  }
  return "not_a_chromaticity";
}

std::string_view WhyNoCct(const ColorAnswer& answer) {
  switch (answer.cct.status) {
    case CctStatus::kOk:
      return "none: too noisy";
    case CctStatus::kFarFromLocus:
      return "none: |Duv| is above 0.05";
    case CctStatus::kBelowRange:
      return "none: colder than 1000 K";
    default:
      return "none: bluer than an infinitely hot body";
  }
}

// ---- JSON ----

Node RgbNode(const ColorAnswer& answer) {
  Node rgb = Node::Table();
  for (const NamedSpace& space : kSpaces) {
    const Rgb c = RgbOf(answer.xy, space, answer.extras);
    rgb.Put(space.key, {c.r, c.g, c.b});
  }
  return rgb;
}

Node Pair(Xy xy) { return {xy.x, xy.y}; }
Node Triple(const std::optional<Xyz>& c) { return c ? Node{c->X, c->Y, c->Z} : Node(); }

Node ReportedNode(const ReportedColor& reported) {
  Node node = {{"illuminance_lx", reported.illuminance_lx},
               {"cct_K", reported.cct_K},
               {"duv", reported.duv},
               {"xy", reported.xy ? Pair(*reported.xy) : Node()},
               {"XYZ", Triple(reported.xyz)}};
  node.Put(ReportedMetricsNode(reported));
  return node;
}

// ---- Tables ----

// A fixed number of decimals; what rounds to zero has no sign.
std::string Fixed(double value, int decimals) {
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;
  std::array<char, 400> text{};  // the largest double has 309 digits before its point
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}
std::string CctText(const ColorAnswer& answer) {
  return answer.has_cct() ? Fixed(answer.cct.temperature.value(), 1)
                          : std::string(WhyNoCct(answer));
}
std::string Claimed(const std::optional<double>& value) {
  return value ? ShortestText(*value) : std::string();
}

}  // namespace

Node ToJson(const ColorAnswer& answer) {
  const Uv1960 uv = Uv1960FromXy(answer.xy);
  const Uv1976 uv76 = Uv1976FromXy(answer.xy);
  const auto& der = answer.melanopic_der;
  const auto& lux = answer.illuminance;
  Node node = {
      {"name", Node::UnlessEmpty(answer.name)},
      {"xy", Pair(answer.xy)},
      {"uv1960", {uv.u, uv.v}},
      {"uv1976", {uv76.u, uv76.v}},
      {"cct_K", answer.has_cct() ? Node(answer.cct.temperature) : Node()},
      {"duv", answer.cct.duv},
      {"cct_valid", answer.has_cct()},
      {"cct_status", answer.findings.too_noisy() ? "too_noisy" : StatusWord(answer.cct.status)},
      {"rgb", RgbNode(answer)},
      {"XYZ", Triple(answer.xyz)},
      {"illuminance_lx", lux},
      {"ler_lm_per_W", answer.efficacy}};
  if (der) node.Put("melanopic", {{"der", *der}, {"edi_lx", lux ? *der * *lux : lux}});
  node.Put(MetricsNode(answer.metrics));
  if (const auto& tlci = answer.tlci) {
    node.Put("tlci", {{"Qa", tlci->qa},
                      {"by", tlci->by},
                      {"far_from_white", tlci->far_from_white ? Node(true) : Node()}});
  }
  node.Put(ColorExtrasNode(answer.xy, answer.extras, answer.findings));
  if (answer.reported) node.Put("reported", ReportedNode(*answer.reported));
  return node;
}

std::string TableOfOne(const ColorAnswer& answer) {
  const bool reports = answer.reported.has_value();
  const ReportedColor reported = answer.reported.value_or(ReportedColor{});
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](std::string what, std::string value, std::string unit,
                       std::string claim = "") {
    rows.push_back({std::move(what), std::move(value), std::move(unit)});
    if (reports) rows.back().push_back(std::move(claim));
  };
  const auto coordinates = [](double a, double b) { return Fixed(a, 6) + "  " + Fixed(b, 6); };
  if (answer.illuminance) {
    row("illuminance", RoundedText(answer.illuminance->value(), 6), "lx",
        Claimed(reported.illuminance_lx));
  }
  row("CCT", CctText(answer), answer.has_cct() ? "K" : "", Claimed(reported.cct_K));
  row("Duv", Fixed(answer.cct.duv, 6), "", Claimed(reported.duv));
  row("x  y", coordinates(answer.xy.x, answer.xy.y), "",
      reported.xy ? coordinates(reported.xy->x, reported.xy->y) : "");
  const Uv1960 uv = Uv1960FromXy(answer.xy);
  const Uv1976 uv76 = Uv1976FromXy(answer.xy);
  row("u  v", coordinates(uv.u, uv.v), "");
  row("u' v'", coordinates(uv76.u, uv76.v), "");
  for (const NamedSpace& space : kSpaces) {
    const Rgb c = RgbOf(answer.xy, space, answer.extras);
    row(std::string(space.title), Fixed(c.r, 5) + "  " + Fixed(c.g, 5) + "  " + Fixed(c.b, 5), "");
  }
  if (answer.efficacy) {
    row("efficacy of radiation", Fixed(answer.efficacy->value(), 1), "lm/W");
  }
  if (const auto& der = answer.melanopic_der) {
    row("melanopic DER", Fixed(*der, 3), "");
    if (answer.illuminance) {
      row("melanopic EDI", RoundedText(*der * answer.illuminance->value(), 6), "lx");
    }
  }
  for (const MetricRow& metric : MetricRows(answer.metrics, reported)) {
    row(metric.what, metric.value, "", metric.claim);
  }
  if (const auto& tlci = answer.tlci) {
    row("TLCI Qa by " + tlci->by,
        Fixed(tlci->qa, 1) + (tlci->far_from_white ? " (far from white)" : ""), "");
  }
  for (ExtraRow& extra : ColorExtraRows(answer.xy, answer.extras, answer.findings)) {
    row(std::move(extra.what), std::move(extra.value), std::move(extra.unit));
  }
  std::vector<std::string> header = {"quantity", "value", "unit"};
  if (reports) header.emplace_back("file says");
  return TextTable(header, rows);
}

std::string TableOfMany(const std::vector<ColorAnswer>& answers) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(answers.size());
  for (const ColorAnswer& a : answers) {
    rows.push_back({a.name, a.illuminance ? RoundedText(a.illuminance->value(), 5) : "", CctText(a),
                    Fixed(a.cct.duv, 5), Fixed(a.xy.x, 5), Fixed(a.xy.y, 5)});
  }
  return TextTable({"spectrum", "lx", "CCT in K", "Duv", "x", "y"}, rows);
}

}  // namespace lightcal::app
