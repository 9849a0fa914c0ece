// SPDX-License-Identifier: Apache-2.0
#include "match/match_answer.h"

#include <array>
#include <charconv>
#include <optional>

#include "lightcal/core/joined.h"

namespace lightcal::app {
namespace {

std::string WithDecimals(double value, int decimals) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  const std::string out(text.data(), end.ptr);
  const bool zero = out.find_first_not_of("-0.") == std::string::npos;
  return zero && out.starts_with('-') ? out.substr(1) : out;
}

// "1.2 (0.9 … 2.6)"
std::string Cell(double value, const std::optional<Uncertain>& interval, int decimals) {
  std::string text = WithDecimals(value, decimals);
  if (interval && interval->low && interval->high) {
    text += " (" + WithDecimals(*interval->low, decimals) + " … " +
            WithDecimals(*interval->high, decimals) + ")";
  }
  return text;
}

std::vector<std::string> RowOf(const match::Match& match, const GelSet& set, bool dimmer) {
  const auto& u = match.intervals;
  const auto of = [&](const auto& member) -> std::optional<Uncertain> {
    return u ? std::optional<Uncertain>((*u).*member) : std::nullopt;
  };
  using Intervals = match::Match::Intervals;
  std::vector<std::string> row = {StackTitle(match.gels, set)};
  if (match.camera) row.push_back(Cell(match.camera->median, u ? u->camera : std::nullopt, 1));
  if (match.camera && match.camera->by_camera.size() > 1) {
    row.push_back(WithDecimals(match.camera->worst, 1));
  }
  row.push_back(Cell(match.observer, of(&Intervals::observer), 1));
  row.push_back(WithDecimals(match.delta_uv, 4));
  row.push_back(Cell(match.ssi, of(&Intervals::ssi), 0));
  row.push_back(match.cct.valid()
                    ? Cell(match.cct.temperature.value(), u ? u->cct_K : std::nullopt, 0) + " K"
                    : kNone);
  row.push_back(match.cct.valid() ? Cell(match.cct.duv, u ? u->duv : std::nullopt, 4) : kNone);
  row.push_back(Cell(match.stops_lost, of(&Intervals::stops_lost), 2));
  if (dimmer) {
    row.push_back(match.dimmer_stops
                      ? Cell(*match.dimmer_stops, u ? u->dimmer_stops : std::nullopt, 2)
                      : kNone);
  }
  return row;
}

}  // namespace

std::string StackTitle(const std::vector<std::size_t>& gels, const GelSet& set) {
  if (gels.empty()) return "no gel";
  return Joined(gels, " + ", [&](std::size_t gel) { return GelTitle(set.gels[gel]); });
}

Node LightNode(const std::string& title, Xy xy, const CctResult& cct) {
  Node node = {{"name", title}, {"xy", {xy.x, xy.y}}};
  if (cct.valid()) {
    node.Put("cct_K", cct.temperature.value());
    node.Put("duv", cct.duv);
  }
  return node;
}

Node MatchNode(const match::Match& match, const GelSet& set) {
  Node delta_e = {{"observer", match.observer}};
  Node skin = {{"observer", match.observer_skin}};
  if (match.camera) {
    delta_e.Put("camera", match.camera->median);
    skin.Put("camera", match.camera->skin);
    if (match.camera->by_camera.size() > 1) {
      delta_e.Put("camera_worst", match.camera->worst);
      delta_e.Put("worst_camera", match.camera->worst_camera);
    }
  }
  Node node = {
      {"gels", Node::List(match.gels, [&](std::size_t g) { return Node(set.gels[g].id); })},
      {"names", Node::List(match.gels, [&](std::size_t g) { return Node(set.gels[g].name); })},
      {"dimmer_stops", match.dimmer_stops},
      {"xy", {match.xy.x, match.xy.y}},
      {"delta_uv", match.delta_uv}};
  if (match.cct.valid()) {
    node.Put("cct_K", match.cct.temperature.value());
    node.Put("duv", match.cct.duv);
  }
  node.Put("delta_e", std::move(delta_e));
  node.Put("delta_e_skin", std::move(skin));
  node.Put("ssi", match.ssi);
  node.Put("stops_lost", match.stops_lost);
  if (!match.intervals) return node;
  const match::Match::Intervals& u = *match.intervals;
  IntervalTables tables;
  tables.Put("dimmer_stops", u.dimmer_stops);
  tables.Put("cct_K", u.cct_K);
  tables.Put("duv", u.duv);
  tables.Put("delta_uv", u.delta_uv);
  tables.Put("ssi", u.ssi);
  tables.Put("stops_lost", u.stops_lost);
  IntervalTables differences;
  differences.Put("observer", u.observer);
  differences.Put("camera", u.camera);
  tables.u95.Put("delta_e", std::move(differences.u95));
  tables.low.Put("delta_e", std::move(differences.low));
  tables.high.Put("delta_e", std::move(differences.high));
  node.Put("u95", std::move(tables.u95));
  node.Put("low95", std::move(tables.low));
  node.Put("high95", std::move(tables.high));
  return node;
}

std::string MatchTable(const std::vector<match::Match>& matches, const match::Match& unfiltered,
                       const GelSet& set) {
  const bool dimmer = unfiltered.dimmer_stops.has_value();
  std::vector<std::string> header = {"gels"};
  if (unfiltered.camera) header.emplace_back("camera ΔE");
  if (unfiltered.camera && unfiltered.camera->by_camera.size() > 1) header.emplace_back("worst");
  for (const char* title : {"eye ΔE", "Δu'v'", "SSI", "CCT", "Duv", "stops lost"}) {
    header.emplace_back(title);
  }
  if (dimmer) header.emplace_back("to dim, stops");
  std::vector<std::vector<std::string>> rows;
  for (const match::Match& each : matches) {
    rows.push_back(RowOf(each, set, dimmer));
    if (each.gels.empty()) rows.back().front() += " (as it is)";
  }
  if (std::ranges::none_of(matches, [](const match::Match& each) { return each.gels.empty(); })) {
    rows.push_back(RowOf(unfiltered, set, dimmer));
    rows.back().front() = "(as it is)";
  }
  return TextTable(header, rows);
}

}  // namespace lightcal::app
