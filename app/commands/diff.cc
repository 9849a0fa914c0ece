// SPDX-License-Identifier: Apache-2.0
// lightcal diff: did the lamp change, or is it only the measurement?
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "commands.h"
#include "lamp_words.h"
#include "light_input.h"
#include "lightcal/calibrate/compare_lights.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

struct DiffOptions {
  std::string a, b;
  std::optional<double> correlation;
  bool fail_on_change = false;
};

constexpr std::array<std::string_view, 4> kChangeWords = {"same", "within_u", "changed",
                                                          "changed_without_u"};
constexpr std::array<std::string_view, 4> kChangeNames = {"same", "within u", "changed beyond u",
                                                          "changed, no u known"};
constexpr int kDigitsWithoutU = 5;

std::string_view Word(const std::array<std::string_view, 4>& words, Change change) {
  return words[static_cast<std::size_t>(change)];
}

Node WithU(const Uncertain& u) {
  return {{"value", u.value},
          {"u95", u.u95 > 0.0 ? Node(u.u95) : Node()},
          {"low95", u.low},
          {"high95", u.high}};
}

Node QuantityNode(const QuantityChange& change) {
  const bool values = change.has_values;
  const bool relative = values && change.before.value != 0.0;
  return {{"quantity", change.quantity},
          {"unit", Node::UnlessEmpty(change.unit)},
          {"old", values ? WithU(change.before) : Node()},
          {"new", values ? WithU(change.after) : Node()},
          {"difference", change.difference},
          {"u95", change.u95 > 0.0 ? Node(change.u95) : Node()},
          {"relative", relative ? Node(change.difference / change.before.value) : Node()},
          {"verdict", Word(kChangeWords, change.change)}};
}

Node ChangeNode(const LightChange& light) {
  return {{"name", light.name},
          {"in", light.before && light.after ? "both" : (light.before ? "old" : "new")},
          {"changed", light.Changed()},
          {"kind_changed", light.kind_changed ? Node(true) : Node()},
          {"common_meter", Node::UnlessEmpty(light.common_meter)},
          {"quantities", Node::List(light.quantities, QuantityNode)}};
}

Node ToJson(const DiffOptions& options, const LightComparison& comparison) {
  return {{"old", options.a},
          {"new", options.b},
          {"coverage", 0.95},
          {"correlation", options.correlation.value_or(0.0)},
          {"shared_inputs", comparison.shared_inputs},
          {"changed", comparison.Changed()},
          {"lights", Node::List(comparison.lights, ChangeNode)}};
}

std::string ValueText(const Uncertain& u, const std::string& unit) {
  if (u.u95 > 0.0 && !IsEven(u)) return ValueAndInterval(u, unit);
  if (u.u95 > 0.0) return ValueWithAbsolute(u.value, u.u95, unit);
  return RoundedText(u.value, kDigitsWithoutU) + (unit.empty() ? "" : " " + unit);
}

std::string DifferenceText(const QuantityChange& change) {
  if (change.change == Change::kSame) return "0";
  std::string text = ValueText({change.difference, change.u95, {}, {}}, change.unit);
  if (change.has_values && change.difference > 0.0) text.insert(0, "+");
  return text;
}

std::string RelativeText(const QuantityChange& change) {
  const bool ratio = change.quantity != "color.duv" && change.quantity != "distance_offset_m";
  if (!change.has_values || !ratio || change.before.value == 0.0) return "-";
  const double percent = 100.0 * change.difference / change.before.value;
  return (percent > 0.0 ? "+" : "") + RoundedText(percent, 2) + " %";
}

std::string Table(const LightComparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const LightChange& light : comparison.lights) {
    if (!light.before || !light.after) {
      rows.push_back({light.name, "-", light.before ? "there" : "-", light.after ? "there" : "-",
                      "-", "-", light.before ? "gone" : "new"});
    }
    if (light.kind_changed) rows.push_back({light.name, "kind", "-", "-", "-", "-", "changed"});
    for (const QuantityChange& change : light.quantities) {
      const bool values = change.has_values;
      rows.push_back({light.name, change.quantity,
                      values ? ValueText(change.before, change.unit) : "-",
                      values ? ValueText(change.after, change.unit) : "-", DifferenceText(change),
                      RelativeText(change), std::string(Word(kChangeNames, change.change))});
    }
  }
  return TextTable(
      {"light", "quantity", "old (95 %)", "new (95 %)", "difference (95 %)", "relative", "verdict"},
      rows);
}

std::string Assumption(const DiffOptions& options, const LightComparison& comparison) {
  const double correlation = options.correlation.value_or(0.0);
  std::string text = "u is the 95 % half width of a difference whose two errors are " +
                     (correlation == 0.0 ? std::string("independent")
                                         : "correlated by " + RoundedText(correlation, 2)) +
                     ": of lamps that did not change, 1 quantity in 20 exceeds it.\n";
  if (comparison.same_inputs) {
    return text +
           "Both were made from the same files: what differs is the program or its settings, "
           "not the lamp.\n";
  }
  if (!comparison.shared_inputs.empty()) {
    return text + std::to_string(comparison.shared_inputs.size()) +
           " input files are the same on both sides; their errors are common, so that less would "
           "be a change.\n";
  }
  const auto common = std::ranges::find_if(
      comparison.lights, [](const LightChange& light) { return !light.common_meter.empty(); });
  if (common != comparison.lights.end()) {
    text += "The meter " + common->common_meter +
            " read both: its own error is common, and not in the differences of light. If they are "
            "two of one name: --correlation 0.\n";
  } else if (!options.correlation) {
    text +=
        "One meter read both? Its gain is common, and smaller changes are real: say so with "
        "--correlation 0.5, or give it one name in both sessions.\n";
  }
  return text;
}

Result<void> RunDiff(const DiffOptions& options, Console& console) {
  const auto a = LightsIn(options.a);
  if (!a) return tl::unexpected(a.error());
  const auto b = LightsIn(options.b);
  if (!b) return tl::unexpected(b.error());
  const LightComparison comparison = CompareLights(*a, *b, options.correlation);
  const Node document = ToJson(options, comparison);
  console.Print(Table(comparison) + "\n" + Assumption(options, comparison));
  if (options.fail_on_change && comparison.Changed()) {
    return EndWithError(console, document,
                        {ErrorKind::kFailed, "changed", options.b,
                         "differs from " + options.a + " beyond what both are unsure of"});
  }
  console.PrintDocument(document);
  return {};
}

}  // namespace

Run BuildDiff(CLI::App& parser) {
  auto options = std::make_shared<DiffOptions>();
  const std::string what = "light.json, STEM.preset.json, or a session that was run";
  parser.add_option("old", options->a, what)->required();
  parser.add_option("new", options->b, what)->required();
  parser
      .add_option("--correlation", options->correlation,
                  "Of the errors of both: 0 = independent, 1 = wholly common [the error of a meter "
                  "of one name common, all else independent]")
      ->check(CLI::Range(0.0, 1.0));
  parser.add_flag("--fail-on-change", options->fail_on_change,
                  "Exit 1 where anything changed beyond its uncertainty");
  return [options](Console& console) { return RunDiff(*options, console); };
}

}  // namespace lightcal::app
