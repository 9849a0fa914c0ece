// SPDX-License-Identifier: Apache-2.0
#include "tradeoff_answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "console.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/report/style.h"
#include "lightcal/report/text.h"
#include "lightcal/report/work_precision.h"
#include "picture_file.h"
#include "truth_answer.h"

namespace lightcal::app {
namespace {

using report::Escaped;
using tradeoff::Setting;
using tradeoff::Study;
using tradeoff::SweepRow;

constexpr double kSeenError = 1e-9;
constexpr double kSeenChangeOfU = 0.01;  // of u: the strictest setting draws it to half of that

std::string Percent(double relative) {
  return relative < kSeenError ? "none" : PercentText(relative);
}
std::string Milliseconds(double seconds) { return RoundedText(1e3 * seconds, 3); }

// "0.02 % in the strength of key", "0.4 mired in the colour temperature of key".
std::string Moved(const tradeoff::SettingError& error) {
  std::string size = Percent(error.relative);
  if (error.quantity == tradeoff::kColorTemperature) {
    size = RoundedText(tradeoff::kMiredPerUnit * error.relative, 2) + " mired";
  }
  if (error.quantity == tradeoff::kDuv)
    size = RoundedText(tradeoff::kDuvPerUnit * error.relative, 2);
  return "the " + std::string(error.quantity) + " of " + error.light + " by " + size;
}

std::string Speed(double times) {
  if (times > 1.0) return RoundedText(times, 3) + "x faster";
  return times < 1.0 ? RoundedText(1.0 / times, 3) + "x slower" : "same";
}

std::string VerdictWord(const Setting& setting) {
  return std::string(tradeoff::kVerdictWords[static_cast<std::size_t>(setting.verdict)]);
}

std::string LevelOf(const SweepRow& row) {
  const tradeoff::Knob& knob = tradeoff::Knobs()[row.knob];
  return std::string(knob.levels[row.setting.levels[row.knob]]);
}

double TimesFaster(const Study& study, const Setting& setting) {
  const auto& usual = study.usual.measured.times;
  const auto& own = setting.measured.times;
  return tradeoff::TimesOverlap(usual, own) ? 1.0 : usual.total / own.total;
}

// "0.02 %", "none, u -3 %".
std::string OffBy(const Setting& setting) {
  std::string text = Percent(setting.error.relative);
  if (std::abs(setting.u_change) < kSeenChangeOfU) return text;
  return text + ", u " + (setting.u_change > 0.0 ? "+" : "") + PercentText(setting.u_change);
}

struct Cells {
  std::string knob, level, time, speed, error, label;
};

Cells CellsOf(std::string knob, std::string level, const Setting& setting, double times_faster) {
  if (setting.measured.refused) {
    return {std::move(knob),     std::move(level), "", "", setting.measured.refused->code,
            VerdictWord(setting)};
  }
  return {std::move(knob),     std::move(level), Milliseconds(setting.measured.times.total),
          Speed(times_faster), OffBy(setting),   VerdictWord(setting)};
}

// The usual setting, then every knob's every level.
std::vector<Cells> KnobRows(const Study& study) {
  std::vector<Cells> rows = {CellsOf("as usual", "", study.usual, 1.0)};
  for (const SweepRow& row : study.rows) {
    rows.push_back(CellsOf(std::string(tradeoff::Knobs()[row.knob].name), LevelOf(row), row.setting,
                           row.times_faster));
    if (!row.in_play) rows.back().label = "not in play";
  }
  return rows;
}

std::vector<Cells> CombinationRows(const Study& study) {
  std::vector<Cells> rows;
  for (const Setting& one : study.combinations) {
    rows.push_back(CellsOf("", tradeoff::NameOf(one.levels), one, TimesFaster(study, one)));
  }
  return rows;
}

std::string Share(double over_u) {
  if (over_u < 1e-6) return "nothing of your u";
  if (over_u > 1.0) return RoundedText(over_u, 2) + " times your u";
  return "1/" + RoundedText(1.0 / over_u, 2) + " of your u";
}

std::string Effect(const Setting& setting, double times_faster) {
  const bool moves = setting.error.relative >= kSeenError;
  const bool widens = std::abs(setting.u_change) >= kSeenChangeOfU;
  std::string what = moves ? "moves " + Moved(setting.error) : "";
  if (widens) {
    what += (moves ? " and u by " : "moves your u by ") + PercentText(setting.u_change);
  }
  what = moves || widens ? what + ", " + Share(setting.error.over_u) : "changes nothing";
  return Speed(times_faster) + ", " + what + ": " + VerdictWord(setting);
}

Node TimesNode(const tradeoff::RunTimes& times) {
  Node stages = Node::Table();
  for (std::size_t i = 0; i < tradeoff::kStages; ++i) {
    stages.Put(tradeoff::kStageWords[i], 1e3 * times.median[i]);
  }
  return {{"median", 1e3 * times.total}, {"least", 1e3 * times.least}, {"low", 1e3 * times.low},
          {"high", 1e3 * times.high},    {"runs", times.runs},         {"stages", stages}};
}

Node SettingNode(const Study& study, const Setting& setting) {
  Node node = {{"name", tradeoff::NameOf(setting.levels)}, {"label", VerdictWord(setting)}};
  if (const auto& refused = setting.measured.refused) {
    node.Put("refused", refused->code);
    return node;
  }
  const auto& error = setting.error;
  node.Put({{"time_ms", TimesNode(setting.measured.times)},
            {"times_faster", TimesFaster(study, setting)},
            {"error_relative", error.relative},
            {"error_over_u", error.over_u},
            {"u_change_relative", setting.u_change}});
  if (!error.light.empty()) {
    node.Put("error_in", {{"light", error.light}, {"quantity", error.quantity}});
  }
  return node;
}

report::WorkPoint PointOf(const Setting& setting, report::WorkPointKind kind) {
  const tradeoff::RunTimes& t = setting.measured.times;
  return {tradeoff::NameOf(setting.levels), t.total, t.low, t.high, setting.error.relative, kind};
}

report::WorkPrecision PlotOf(const Study& study, double tolerance, const std::string& title) {
  using Kind = report::WorkPointKind;
  report::WorkPrecision plot{
      title + ": accuracy against time", {}, {}, tolerance, study.allowed_relative};
  plot.points.push_back(PointOf(study.usual, Kind::kUsual));
  const std::vector<const Setting*> all = tradeoff::AllSettings(study);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (!all[i]->measured.refused) plot.points.push_back(PointOf(*all[i], Kind::kSetting));
  }
  if (study.recommended.levels != study.usual.levels) {
    plot.points.push_back(PointOf(study.recommended, Kind::kRecommended));
  }
  for (const std::size_t i : tradeoff::ParetoOf(study)) {
    plot.best.push_back(PointOf(*all[i], i == 0 ? Kind::kUsual : Kind::kSetting));
    if (all[i]->levels == study.recommended.levels) plot.best.back().kind = Kind::kRecommended;
  }
  return plot;
}

// The first row is the header, the first cell of each names it.
std::string HtmlTable(const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<table><thead><tr>";
  for (const std::string& cell : rows.front()) {
    html += "<th scope=\"col\">" + Escaped(cell) + "</th>";
  }
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    html += "<tr><th scope=\"row\">" + Escaped(rows[i].front()) + "</th>";
    for (std::size_t k = 1; k < rows[i].size(); ++k) html += "<td>" + Escaped(rows[i][k]) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string HtmlTable(const std::string& heading, const std::vector<Cells>& cells) {
  std::vector<std::vector<std::string>> rows = {
      {heading, "level", "time (ms)", "against usual", "off by", "label"}};
  for (const Cells& row : cells) {
    rows.push_back({row.knob, row.level, row.time, row.speed, row.error, row.label});
  }
  return HtmlTable(rows);
}

std::string Page(const Study& study, const TruthRows& truth, const std::string& title,
                 const std::string& svg) {
  std::string html =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n<meta name=\"generator\" content=\"" +
      Escaped(GeneratorName()) + "\"/>\n<title>" + Escaped(title) +
      " · accuracy and time</title>\n<style>" + report::StyleSheet() +
      "</style>\n</head>\n<body>\n<main>\n<header><h1>" + Escaped(title) +
      "</h1>\n<p class=\"lead\">What accuracy costs in time, measured on this session</p></header>"
      "\n<figure>" +
      svg + "</figure>\n<div class=\"block\">\n";
  for (const std::string& sentence : TradeoffSentences(study, truth)) {
    html += "<p>" + Escaped(sentence) + "</p>\n";
  }
  html += "</div>\n" + HtmlTable("knob", KnobRows(study));
  const std::vector<Cells> together = CombinationRows(study);
  if (!together.empty()) html += HtmlTable("together", together);
  if (!truth.empty()) html += HtmlTable(TruthCells(truth));
  return html +
         "<p class=\"small soft\">Off by: the largest change of strength, flux, colour temperature "
         "or Duv against the strictest setting; 1 % stands for 1 mired or 0.001 of Duv; and what "
         "becomes of your standard uncertainty u. Free: below a tenth of u; safe: up to a "
         "third.</p>\n"
         "</main>\n</body>\n</html>\n";
}

}  // namespace

std::string TradeoffTable(const Study& study, const TruthRows& truth) {
  std::vector<std::vector<std::string>> rows;
  for (const Cells& row : KnobRows(study)) {
    rows.push_back({row.knob, row.level, row.time, row.speed, row.error, row.label});
  }
  std::string text = TextTable({"knob", "level", "ms", "against usual", "off by", "label"}, rows);
  rows.clear();
  for (const Cells& row : CombinationRows(study)) {
    rows.push_back({row.time, row.speed, row.error, row.label, row.level});
  }
  if (!rows.empty()) {
    text += "\n" + TextTable({"ms", "against usual", "off by", "label", "together"}, rows);
  }
  if (truth.empty()) return text;
  rows = TruthCells(truth);
  const std::vector<std::string> header = std::move(rows.front());
  rows.erase(rows.begin());
  return text + "\n" + TextTable(header, rows);
}

std::vector<std::string> TradeoffSentences(const Study& study, const TruthRows& truth) {
  std::vector<std::string> out = {
      "Recommended: " + tradeoff::NameOf(study.recommended.levels) + " (" +
      Milliseconds(study.recommended.measured.times.total) + " ms; " +
      Effect(study.recommended, TimesFaster(study, study.recommended)) + ")."};
  if (!truth.empty()) out.push_back(TruthSentence(truth));
  for (const SweepRow& row : study.rows) {
    const bool good = row.setting.verdict == tradeoff::Verdict::kFree ||
                      row.setting.verdict == tradeoff::Verdict::kSafe;
    if (!good || !(row.times_faster > 1.0)) continue;
    out.push_back(tradeoff::NameOf(row.setting.levels) + ": " +
                  Effect(row.setting, row.times_faster));
  }
  if (study.meter_limits) {
    out.push_back("Your readings are the limit: a third of their u is " +
                  Percent(study.allowed_relative) + "; working finer than that buys nothing.");
    for (const tradeoff::LightFigures& light : study.reference.lights) {
      if (light.limit.empty()) continue;
      out.push_back("What limits " + light.name + ": " + light.limit + ".");
    }
  }
  return out;
}

Node TradeoffNode(const Study& study, const TruthRows& truth, double tolerance_relative) {
  const auto knob = [&](const SweepRow& row) {
    Node node = {{"knob", tradeoff::Knobs()[row.knob].name}, {"level", LevelOf(row)}};
    node.Put(SettingNode(study, row.setting));
    node.Put("in_play", row.in_play);
    return node;
  };
  const auto setting = [&](const Setting& one) { return SettingNode(study, one); };
  return {
      {"tolerance_relative", tolerance_relative},
      {"allowed_relative", study.allowed_relative},
      {"meter_limits", study.meter_limits},
      {"reference",
       {{"time_ms", TimesNode(study.reference.times)}, {"self_difference", study.self_difference}}},
      {"usual", SettingNode(study, study.usual)},
      {"knobs", Node::List(study.rows, knob)},
      {"combinations", Node::List(study.combinations, setting)},
      {"recommended", SettingNode(study, study.recommended)},
      {"against_truth", Node::UnlessEmpty(Node::List(truth, TruthNode))},
      {"sentences", TradeoffSentences(study, truth)}};
}

Result<std::vector<OutputFile>> TradeoffFiles(const Study& study, const TruthRows& truth,
                                              double tolerance_relative, const std::string& title) {
  Node measured = SettingNode(study, study.recommended);
  measured.Put("session", title);
  Node with_figures = DocumentOf(study.recommended.measured.profile);
  with_figures.Put("measured", std::move(measured));
  auto profile = records::FiniteJson(with_figures);
  if (!profile) return Propagate(std::move(profile));
  Node whole = {{"generator", GeneratorName()}};
  whole.Put(TradeoffNode(study, truth, tolerance_relative));
  const std::string svg = report::WorkPrecisionPlot(PlotOf(study, tolerance_relative, title));
  auto png = PictureFile("tradeoff.png", svg);
  if (!png) return Propagate(std::move(png));
  return std::vector<OutputFile>{
      {"tradeoff.json", PrintJson(whole, records::JsonLayout::kPretty) + "\n"},
      {"profile.json", *std::move(profile)},
      {"tradeoff.svg", svg},
      std::move(*png),
      {"tradeoff.html", Page(study, truth, title, svg)}};
}

}  // namespace lightcal::app
