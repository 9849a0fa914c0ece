// SPDX-License-Identifier: Apache-2.0
#include "tradeoff_answer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "console.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/report/minutes_figure.h"
#include "lightcal/report/style.h"
#include "lightcal/report/text.h"
#include "lightcal/report/work_precision.h"
#include "minutes_answer.h"
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

// "0.02 %", "none, u -3 %".
std::string OffBy(const Setting& setting) {
  std::string text = Percent(setting.error.relative);
  if (std::abs(setting.u_change) < kSeenChangeOfU) return text;
  return text + ", u " + (setting.u_change > 0.0 ? "+" : "") + PercentText(setting.u_change);
}

struct Cells {
  std::string knob, level, time, spread, speed, error, label;
};

std::string Spread(const tradeoff::RunTimes& times) {
  return Milliseconds(times.low) + " to " + Milliseconds(times.high);
}

Cells CellsOf(std::string knob, std::string level, const Setting& setting, double times_faster) {
  if (setting.measured.refused) {
    return {std::move(knob),     std::move(level), "", "", "", setting.measured.refused->code,
            VerdictWord(setting)};
  }
  const tradeoff::RunTimes& times = setting.measured.times;
  return {std::move(knob),     std::move(level), Milliseconds(times.total), Spread(times),
          Speed(times_faster), OffBy(setting),   VerdictWord(setting)};
}

// The usual setting as it was measured in turns with these.
Setting UsualBeside(const Study& study, const Setting& one) {
  Setting usual = study.usual;
  usual.measured.times = one.usual;
  return usual;
}

// The usual setting, then every knob's every level that is in play.
std::vector<Cells> KnobRows(const Study& study) {
  const Setting usual =
      study.rows.empty() ? study.usual : UsualBeside(study, study.rows.front().setting);
  std::vector<Cells> rows = {CellsOf("as usual", "", usual, 1.0)};
  for (const SweepRow& row : study.rows) {
    if (!row.in_play) continue;
    rows.push_back(CellsOf(std::string(tradeoff::Knobs()[row.knob].name), LevelOf(row), row.setting,
                           row.times_faster));
  }
  return rows;
}

std::vector<Cells> CombinationRows(const Study& study) {
  std::vector<Cells> rows;
  if (study.combinations.empty()) return rows;
  rows.push_back(CellsOf("", "as usual", UsualBeside(study, study.combinations.front()), 1.0));
  for (const Setting& one : study.combinations) {
    rows.push_back(CellsOf("", tradeoff::NameOf(one.levels), one, one.TimesFaster()));
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

bool NothingToTrade(const Study& study) { return study.recommended.levels == study.usual.levels; }

std::string Recommendation(const Study& study) {
  const std::string takes =
      Milliseconds(study.recommended.measured.times.total) + " ms of processor time";
  if (NothingToTrade(study)) {
    return "Nothing to trade here: leave it as it is (" + takes +
           "), your readings are the limit; no setting that is good enough saves " +
           PercentText(tradeoff::kLeastSaved) + " of that.";
  }
  if (study.saved_share == 0.0) {
    return "Recommended: " + tradeoff::NameOf(study.recommended.levels) + " (" + takes +
           "): as usual is not good enough here.";
  }
  return "Recommended: " + tradeoff::NameOf(study.recommended.levels) + " (" + takes + ", saves " +
         PercentText(study.saved_share) + "; " +
         Effect(study.recommended, study.recommended.TimesFaster()) + ").";
}

Node TimesNode(const tradeoff::RunTimes& times) {
  Node stages = Node::Table();
  for (std::size_t i = 0; i < tradeoff::kStages; ++i) {
    stages.Put(tradeoff::kStageWords[i], 1e3 * times.median[i]);
  }
  return {{"median", 1e3 * times.total}, {"least", 1e3 * times.least}, {"low", 1e3 * times.low},
          {"high", 1e3 * times.high},    {"runs", times.runs},         {"stages", stages}};
}

Node SettingNode(const Setting& setting, double times_faster) {
  Node node = {{"name", tradeoff::NameOf(setting.levels)}, {"label", VerdictWord(setting)}};
  if (const auto& refused = setting.measured.refused) {
    node.Put("refused", refused->code);
    return node;
  }
  const auto& error = setting.error;
  node.Put({{"time_ms", TimesNode(setting.measured.times)},
            {"times_faster", times_faster},
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
  const auto add = [&](const Setting& one) {
    if (!one.measured.refused) plot.points.push_back(PointOf(one, Kind::kSetting));
  };
  for (const SweepRow& row : study.rows) {
    if (row.in_play) add(row.setting);
  }
  for (const Setting& one : study.combinations) add(one);
  if (study.recommended.levels != study.usual.levels) {
    plot.points.push_back(PointOf(study.recommended, Kind::kRecommended));
  }
  const std::vector<const Setting*> all = tradeoff::AllSettings(study);
  for (const std::size_t i : tradeoff::ParetoOf(study)) {
    plot.best.push_back(PointOf(*all[i], i == 0 ? Kind::kUsual : Kind::kSetting));
    if (all[i]->levels == study.recommended.levels) plot.best.back().kind = Kind::kRecommended;
  }
  return plot;
}

// What its column does not say; each table was measured in turns with its own usual setting.
constexpr std::string_view kAgainstUsual =
    "Against usual: the whole run, by what the knob's own stage takes less or more; the other "
    "stages differ by chance.";

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
      {heading, "level", "processor ms", "quartiles", "against usual", "off by", "label"}};
  for (const Cells& row : cells) {
    rows.push_back({row.knob, row.level, row.time, row.spread, row.speed, row.error, row.label});
  }
  return HtmlTable(rows);
}

// One table a light.
std::string MinutesHtml(const std::vector<MinutesLadder>& ladders) {
  std::string html;
  for (const MinutesLadder& ladder : ladders) {
    const auto rows = MinutesCells(ladder);
    if (rows.size() > 1) html += HtmlTable(rows);
  }
  return html;
}

std::string Page(const TradeoffAnswer& answer, const std::string& title, const std::string& svg) {
  const auto& [study, truth, ladders, tolerance] = answer;
  std::string html =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n<meta name=\"generator\" content=\"" +
      Escaped(GeneratorName()) + "\"/>\n<title>" + Escaped(title) +
      " · accuracy and time</title>\n<style>" + report::StyleSheet() +
      "</style>\n</head>\n<body>\n<main>\n<header><h1>" + Escaped(title) +
      "</h1>\n<p class=\"lead\">What accuracy costs in processor time, measured on this session, "
      "and in yours</p></header>"
      "\n<figure>" +
      svg + "</figure>\n<div class=\"block\">\n";
  for (const std::string& sentence : TradeoffSentences(answer)) {
    html += "<p>" + Escaped(sentence) + "</p>\n";
  }
  html += "</div>\n" + HtmlTable("knob", KnobRows(study));
  const std::vector<Cells> together = CombinationRows(study);
  if (!together.empty()) html += HtmlTable("together", together);
  if (!truth.empty()) html += HtmlTable(TruthCells(truth));
  const std::string minutes = report::MinutesPlot(ladders);
  if (!minutes.empty()) {
    html += "<h2>What the next minutes of measuring buy</h2>\n<figure>\n" + minutes +
            "</figure>\n" + MinutesHtml(ladders);
  }
  return html + "<p class=\"small soft\">" + std::string(kAgainstUsual) +
         " Off by: the largest change of strength, flux, colour temperature "
         "or Duv against the strictest setting; 1 % stands for 1 mired or 0.001 of Duv; and what "
         "becomes of your standard uncertainty u. Free: below a tenth of u; safe: up to a "
         "third.</p>\n"
         "</main>\n</body>\n</html>\n";
}

}  // namespace

std::string TradeoffTable(const TradeoffAnswer& answer) {
  const auto& [study, truth, ladders, tolerance] = answer;
  std::vector<std::vector<std::string>> rows;
  for (const Cells& row : KnobRows(study)) {
    rows.push_back({row.knob, row.level, row.time, row.spread, row.speed, row.error, row.label});
  }
  std::string text =
      TextTable({"knob", "level", "ms", "quartiles", "against usual", "off by", "label"}, rows) +
      std::string(kAgainstUsual) + "\n";
  rows.clear();
  for (const Cells& row : CombinationRows(study)) {
    rows.push_back({row.time, row.spread, row.speed, row.error, row.label, row.level});
  }
  if (!rows.empty()) {
    text +=
        "\n" + TextTable({"ms", "quartiles", "against usual", "off by", "label", "together"}, rows);
  }
  if (!truth.empty()) {
    rows = TruthCells(truth);
    const std::vector<std::string> header = std::move(rows.front());
    rows.erase(rows.begin());
    text += "\n" + TextTable(header, rows);
  }
  const std::string minutes = MinutesTable(ladders);
  return minutes.empty() ? text : text + "\n" + minutes;
}

std::vector<std::string> TradeoffSentences(const TradeoffAnswer& answer) {
  const auto& [study, truth, ladders, tolerance] = answer;
  std::vector<std::string> out = {Recommendation(study)};
  if (!truth.empty()) {
    if (std::string judged = TruthSentence(study, truth); !judged.empty()) {
      out.push_back(std::move(judged));
    }
  }
  if (const auto idle = tradeoff::KnobsNotInPlay(study); !idle.empty()) {
    out.push_back("Not in play here: " + Joined(idle) + ".");
  }
  for (const SweepRow& row : study.rows) {
    const bool good = row.setting.verdict == tradeoff::Verdict::kFree ||
                      row.setting.verdict == tradeoff::Verdict::kSafe;
    const double saved = 1.0 - 1.0 / row.times_faster;
    if (!good || saved < tradeoff::kLeastSaved) continue;
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
  std::ranges::copy(MinutesSentences(ladders), std::back_inserter(out));
  return out;
}

Node TradeoffNode(const TradeoffAnswer& answer) {
  const auto& [study, truth, ladders, tolerance] = answer;
  const auto knob = [](const SweepRow& row) {
    Node node = {{"knob", tradeoff::Knobs()[row.knob].name}, {"level", LevelOf(row)}};
    node.Put(SettingNode(row.setting, row.times_faster));
    node.Put("in_play", row.in_play);
    return node;
  };
  const auto setting = [](const Setting& one) { return SettingNode(one, one.TimesFaster()); };
  return {
      {"tolerance_relative", tolerance},
      {"allowed_relative", study.allowed_relative},
      {"meter_limits", study.meter_limits},
      {"reference",
       {{"time_ms", TimesNode(study.reference.times)}, {"self_difference", study.self_difference}}},
      {"usual", SettingNode(study.usual, 1.0)},
      {"knobs", Node::List(study.rows, knob)},
      {"not_in_play", tradeoff::KnobsNotInPlay(study)},
      {"combinations", Node::List(study.combinations, setting)},
      {"recommended", setting(study.recommended)},
      {"nothing_to_trade", NothingToTrade(study)},
      {"saved_relative", study.saved_share},
      {"against_truth", Node::UnlessEmpty(Node::List(truth, TruthNode))},
      {"minutes", Node::UnlessEmpty(Node::List(ladders, MinutesNode))},
      {"sentences", TradeoffSentences(answer)}};
}

Result<std::vector<OutputFile>> TradeoffFiles(const TradeoffAnswer& answer,
                                              const std::string& title) {
  const Study& study = answer.study;
  Node measured = SettingNode(study.recommended, study.recommended.TimesFaster());
  measured.Put("session", title);
  Node with_figures = DocumentOf(study.recommended.measured.profile);
  with_figures.Put("measured", std::move(measured));
  auto profile = records::FiniteJson(with_figures);
  if (!profile) return Propagate(std::move(profile));
  Node whole = {{"generator", GeneratorName()}};
  whole.Put(TradeoffNode(answer));
  const std::string svg =
      report::WorkPrecisionPlot(PlotOf(study, answer.tolerance_relative, title));
  std::vector<OutputFile> files = {
      {"tradeoff.json", PrintJson(whole, records::JsonLayout::kPretty) + "\n"},
      {"profile.json", *std::move(profile)},
      {"tradeoff.html", Page(answer, title, svg)}};
  for (const auto& [name, drawing] : {std::pair<std::string, std::string>("tradeoff", svg),
                                      {"minutes", report::MinutesPlot(answer.ladders)}}) {
    if (drawing.empty()) continue;
    files.push_back({name + ".svg", drawing});
    auto png = PictureFile(name + ".png", drawing);
    if (!png) return Propagate(std::move(png));
    files.push_back(*std::move(png));
  }
  return files;
}

}  // namespace lightcal::app
