// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate_answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "console.h"
#include "lamp_words.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "simulate/effect_rows.h"

namespace lightcal::app {
namespace {

std::string CostText(double ns) {
  if (ns >= 1e6) return RoundedText(ns / 1e6, 3) + " ms";
  return ns >= 1e3 ? RoundedText(ns / 1e3, 3) + " µs" : RoundedText(ns, 3) + " ns";
}

// To the millimetre, without trailing zeros.
std::string MetresText(double metres) { return ShortestText(std::round(metres * 1000.0) / 1000.0); }
std::string PlaceText(const Vec3& p) {
  return MetresText(p[0]) + ", " + MetresText(p[1]) + ", " + MetresText(p[2]);
}

struct Total {
  double lux = 0.0, u95 = 0.0;
};
Total TotalOf(const PredictedPoint& point, double ambient_lx) {
  Total total{ambient_lx, 0.0};
  for (const LampLux& part : point.parts) {
    total.lux += part.direct_lx + part.bounce_lx;
    total.u95 += part.u95_lx;
  }
  return total;
}

// Unsure as a lamp's intensity is, by a factor, until it may be none.
Uncertain LuxOf(double lux, double u95) {
  if (!(u95 < lux)) return {lux, u95, 0.0, lux + u95};
  const Uncertain by_factor = UncertainFromLog(std::log(lux), std::asinh(u95 / lux) / kZ95);
  return {lux, u95, by_factor.low, by_factor.high};
}
std::string LuxText(double lux, double u95) {
  return lux > 0.0 || u95 > 0.0 ? ValueAndInterval(LuxOf(lux, u95), "lx") : "0 lx";
}

// In the room its lamps were measured in: every lamp's part must be known there.
std::optional<Uncertain> RoomTotal(const PredictedPoint& point, double ambient_lx) {
  Uncertain sum{ambient_lx, 0.0, ambient_lx, ambient_lx};
  bool any = false;
  for (std::size_t k = 0; k < point.parts.size(); ++k) {
    const LampLux& part = point.parts[k];
    if (k >= point.in_room.size() || !point.in_room[k]) {
      const double lux = part.direct_lx + part.bounce_lx;
      sum = {sum.value + lux, sum.u95 + part.u95_lx, *sum.low + lux - part.u95_lx,
             *sum.high + lux + part.u95_lx};
      continue;
    }
    any = true;
    const Uncertain& u = *point.in_room[k];
    sum = {sum.value + u.value, sum.u95 + u.u95, *sum.low + *u.low, *sum.high + *u.high};
  }
  return any ? std::optional(sum) : std::nullopt;
}

std::string RoomText(const std::optional<Uncertain>& u) {
  return u ? ValueText(*u) + " lx   " + RangeText(*u) : "-";
}

std::string PointTable(const Simulated& s) {
  std::vector<std::vector<std::string>> rows;
  const bool walls = s.settings.room.has_value();
  const bool in_room = std::ranges::any_of(s.points, [](const PredictedPoint& point) {
    return std::ranges::any_of(point.in_room, [](const auto& u) { return u.has_value(); });
  });
  for (const PredictedPoint& point : s.points) {
    const Total total = TotalOf(point, s.ambient_lx);
    std::string place = PlaceText(point.at.position_m);
    for (std::size_t k = 0; k < s.lamps.size(); ++k) {
      const LampLux& part = point.parts[k];
      const double lux = part.direct_lx + part.bounce_lx;
      std::vector<std::string> row = {
          place, s.lamps[k].name, LuxText(lux, part.u95_lx),
          total.lux > 0.0 ? RoundedText(100.0 * lux / total.lux, 3) + " %" : "-"};
      if (walls) row.push_back(RoundedText(part.bounce_lx, 3) + " lx");
      if (in_room) row.push_back(RoomText(point.in_room[k]));
      rows.push_back(std::move(row));
      place.clear();
    }
    if (s.lamps.size() < 2 && !(s.ambient_lx > 0.0)) continue;
    std::vector<std::string> row = {"", "together", LuxText(total.lux, total.u95), "100 %"};
    if (walls) row.emplace_back("");
    if (in_room) row.push_back(RoomText(RoomTotal(point, s.ambient_lx)));
    rows.push_back(std::move(row));
  }
  const bool everywhere = std::ranges::all_of(
      s.lamps, [](const PlacedLamp& lamp) { return IsEverywhere(lamp.source); });
  // Not one quantity: with walls it is more light, of a wider interval in lux.
  const char* const what = everywhere ? "illuminance (95 %)"
                           : walls    ? "lamp and walls (95 %)"
                                      : "lamp alone (95 %)";
  std::vector<std::string> header = {"at x, y, z (m)", "light", what, "share"};
  if (walls) header.emplace_back("from walls");
  if (in_room) header.emplace_back("in the room it was measured in");
  return TextTable(header, rows);
}

// "+z": the side whose light the map is of.
std::string FacingText(const MapPlane& plane) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = plane.grid.normal[static_cast<int>(i)];
    if (part != 0.0) text = std::string(part > 0.0 ? "+" : "-") + "xyz"[i];
  }
  return text;
}

std::string PlaneText(const Simulated& s) {
  const MapPlane& plane = *s.plane;
  const MapSummary summary = Summarize(s.map, plane, s.border_m);
  const auto text = [](double v) { return RoundedText(v, 4); };
  std::string out = plane.name + ", " + MetresText(std::abs(plane.right - plane.left)) + " x " +
                    MetresText(plane.top - plane.bottom) + " m, " +
                    std::to_string(plane.grid.width) + " x " + std::to_string(plane.grid.height) +
                    " points, facing " + FacingText(plane) + "\n";
  std::vector<std::vector<std::string>> rows = {
      {"least", text(summary.least_lx), "lx"},
      {"mean", text(summary.mean_lx), "lx"},
      {"most", text(summary.most_lx), "lx"},
      {"most at x, y, z", PlaceText(summary.brightest_m), "m"}};
  if (summary.mean_lx > 0.0) {
    rows.push_back({"U0 (least / mean)", RoundedText(summary.least_lx / summary.mean_lx, 3), ""});
    const double wide = summary.median_u95_relative;
    const Uncertain part =
        wide < 1.0 ? IntervalOfFactor(wide) : Uncertain{1.0, wide, 0.0, 1.0 + wide};
    if (IsEven(part)) {
      rows.push_back({"± (95 %, median)", RoundedText(100.0 * part.u95, 2), "%"});
    } else {
      rows.push_back({"95 % (median)", RelativeText(part), ""});
    }
  }
  if (s.border_m > 0.0) out += "without a border of " + MetresText(s.border_m) + " m\n";
  out += TextTable({"illuminance", "value", "unit"}, rows);
  if (!s.target) return out;
  rows.clear();
  for (const GridVerdict& one : JudgeGrid(*s.target, summary)) {
    rows.push_back({std::string(one.what), text(one.asked), text(one.found),
                    one.word == GridVerdict::Word::kOpen ? "within what is not known"
                                                         : std::string(WordOf(one.word))});
  }
  return out + "\n" + TextTable({"target", "asked", "found", "verdict"}, rows);
}

Node LuxNode(const std::optional<Uncertain>& u) {
  if (!u) return {};
  return {{"value", u->value}, {"u95", u->u95}, {"low95", u->low}, {"high95", u->high}};
}

Node PointNode(const Simulated& s, const PredictedPoint& point) {
  const Total total = TotalOf(point, s.ambient_lx);
  Node shares = Node::Array();
  for (std::size_t k = 0; k < s.lamps.size(); ++k) {
    const LampLux& part = point.parts[k];
    shares.items.push_back(
        {{"name", s.lamps[k].name},
         {"illuminance_lx", LuxNode(LuxOf(part.direct_lx + part.bounce_lx, part.u95_lx))},
         {"direct_lx", part.direct_lx},
         {"bounce_lx", part.bounce_lx},
         {"in_room_lx", LuxNode(k < point.in_room.size() ? point.in_room[k] : std::nullopt)}});
  }
  return {{"position_m", point.at.position_m},
          {"normal", point.at.normal},
          {"illuminance_lx", LuxNode(LuxOf(total.lux, total.u95))},
          {"in_room_lx", LuxNode(RoomTotal(point, s.ambient_lx))},
          {"ambient_lx", s.ambient_lx > 0.0 ? Node(s.ambient_lx) : Node()},
          {"lights", shares}};
}

Node VerdictNode(const GridVerdict& one) {
  return {{"what", one.what},
          {"asked", one.asked},
          {"found", one.found},
          {"verdict", WordOf(one.word)}};
}

Node PlaneNode(const Simulated& s) {
  const MapPlane& plane = *s.plane;
  const MapSummary summary = Summarize(s.map, plane, s.border_m);
  return {
      {"name", plane.name},
      {"grid", {plane.grid.width, plane.grid.height}},
      {"across", plane.across_axis},
      {"up", plane.up_axis},
      {"left_m", plane.left},
      {"right_m", plane.right},
      {"bottom_m", plane.bottom},
      {"top_m", plane.top},
      {"normal", plane.grid.normal},
      {"illuminance_lx",
       {{"min", summary.least_lx}, {"mean", summary.mean_lx}, {"max", summary.most_lx}}},
      {"max_at_m", summary.brightest_m},
      {"uniformity_U0", summary.mean_lx > 0.0 ? Node(summary.least_lx / summary.mean_lx) : Node()},
      {"border_m", s.border_m > 0.0 ? Node(s.border_m) : Node()},
      {"target", s.target ? Node::List(JudgeGrid(*s.target, summary), VerdictNode) : Node()},
      {"u95_relative_median", summary.median_u95_relative}};
}

Node LampNode(const PlacedLamp& lamp) {
  const bool aimed = !IsSky(lamp.source);
  return {{"name", lamp.name},
          {"position_m", IsEverywhere(lamp.source) ? Node() : Node(lamp.pose.position_m)},
          {"aim", aimed ? Node(lamp.pose.frame.z) : Node()}};
}

Node EffectNode(const EffectRow& row) {
  return {{"light", row.light},          {"name", row.effect},
          {"state", row.state},          {"evaluations", row.evaluations},
          {"cost_ns", row.cost_ns},      {"reason", row.reason},
          {"bound_left_off", row.bound}, {"points", Node::UnlessEmpty(row.points)}};
}

}  // namespace

MapSummary Summarize(const IlluminanceMap& map, const MapPlane& plane, double border_m) {
  MapSummary out;
  double sum = 0.0;
  std::size_t count = 0;
  std::vector<float> relative;
  std::size_t most = map.lux.size();
  std::size_t least = map.lux.size();
  const auto width = static_cast<std::size_t>(map.width);
  const auto height = static_cast<std::size_t>(map.height);
  const double across = std::abs(plane.right - plane.left) / static_cast<double>(width);
  const double down = std::abs(plane.top - plane.bottom) / static_cast<double>(height);
  // Points stand in the middle of their pixels; a border that leaves none is none.
  const auto cut = [border_m](double step, std::size_t points) {
    const auto n = static_cast<std::size_t>(std::max(0.0, std::ceil(border_m / step - 0.5)));
    return 2 * n < points ? n : std::size_t{0};
  };
  const std::size_t columns = cut(across, width);
  const std::size_t lines = cut(down, height);
  for (std::size_t j = lines; j < height - lines; ++j) {
    for (std::size_t i = j * width + columns; i < (j + 1) * width - columns; ++i) {
      sum += double{map.lux[i]};
      ++count;
      if (most == map.lux.size() || map.lux[i] > map.lux[most]) most = i;
      if (least == map.lux.size() || map.lux[i] < map.lux[least]) least = i;
      if (map.lux[i] > 0.0F) relative.push_back(map.u95[i] / map.lux[i]);
    }
  }
  out.least_lx = double{map.lux[least]};
  out.mean_lx = sum / static_cast<double>(count);
  out.most_lx = double{map.lux[most]};
  out.brightest_m = PointOf(plane, static_cast<int>(most % width), static_cast<int>(most / width));
  if (relative.empty()) return out;
  const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
  std::nth_element(relative.begin(), middle, relative.end());
  out.median_u95_relative = double{*middle};
  return out;
}

std::string AnswerText(const Simulated& s) {
  std::string out;
  if (!s.points.empty()) out += PointTable(s) + "\n";
  if (s.plane) out += PlaneText(s) + "\n";
  std::vector<std::vector<std::string>> rows;
  double cost = 0.0;
  for (const EffectRow& row : EffectRowsOf(s.lamps, s.accounts, s.settings, s.surroundings)) {
    rows.push_back({row.light, row.effect, row.state, CostText(row.cost_ns),
                    row.where.empty() ? "-" : row.where, row.reason});
    cost += row.cost_ns;
  }
  out += TextTable({"light", "effect", "state", "cost", "points", "why"}, rows);
  if (s.elapsed_ms) {
    out += "measured: " + RoundedText(*s.elapsed_ms, 3) + " ms on all processors (declared " +
           CostText(cost) + " of one)\n";
  }
  return out;
}

Node AnswerNode(const Simulated& s) {
  const auto point = [&](const PredictedPoint& one) { return PointNode(s, one); };
  return {{"lights", Node::List(s.lamps, LampNode)},
          {"tolerance", s.settings.tolerance},
          {"points", Node::UnlessEmpty(Node::List(s.points, point))},
          {"plane", s.plane ? PlaneNode(s) : Node()},
          {"effects",
           Node::List(EffectRowsOf(s.lamps, s.accounts, s.settings, s.surroundings), EffectNode)},
          {"elapsed_ms", s.elapsed_ms},
          {"files", Node::UnlessEmpty(s.files)}};
}

}  // namespace lightcal::app
