// SPDX-License-Identifier: Apache-2.0
// lightcal state: a fixture at what its controls say, read or between; or all its states in a
// table.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "calibration_options.h"
#include "commands.h"
#include "lamp_state.h"
#include "lamp_words.h"
#include "light_input.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"
#include "spectrum_csv.h"

namespace lightcal::app {
namespace {

struct StateOptions {
  std::string input, light, at, spectrum;
  bool force = false;
};

constexpr std::array<std::string_view, 3> kBasisTexts = {
    "as it was read", "between states that were read",
    "put together from states that differ in other controls too"};

Result<LightFile> LightsOf(const std::string& input, Console& console) {
  if (std::filesystem::path(input).extension() == ".json") return LightsIn(input);
  auto calibrated = CalibrateAloud(input, CalibrationSettings{}, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  return std::move(calibrated->lights);
}

// The light that is named, or the only one with controls.
Result<const FittedLight*> LightOf(const LightFile& file, const StateOptions& options) {
  std::vector<const FittedLight*> found;
  for (const FittedLight& light : file.lights) {
    const bool fits = options.light.empty() ? !light.states.empty() : light.name == options.light;
    if (fits) found.push_back(&light);
  }
  if (found.size() == 1) return found.front();
  const auto name = [](const FittedLight& light) { return light.name; };
  if (!options.light.empty()) {
    return Refused(
        "unknown_light", options.light,
        "is no light of " + options.input + "; there are " + Joined(file.lights, ", ", name));
  }
  if (found.empty()) {
    return Refused("no_states", options.input,
                   "no light of it was read at states of its controls; give readings "
                   "state = { dimmer = 50 } and the like");
  }
  return WrongUsage("--light", "several lights have states: " +
                                   Joined(found, ", ", [](const auto* one) { return one->name; }));
}

std::string OfFull(const Uncertain& relative) {
  Uncertain percent{100.0 * relative.value, 100.0 * relative.u95, {}, {}};
  if (relative.low) percent.low = 100.0 * *relative.low;
  if (relative.high) percent.high = 100.0 * *relative.high;
  if (!(relative.u95 > 0.0)) return RoundedText(percent.value, 3) + " %";
  return ValueText(percent) + " %";
}

std::string Signed(double value, int digits, const std::string& unit) {
  return (value >= 0.0 ? "+" : "−") + RoundedText(std::abs(value), digits) + " " + unit;
}

// "label 12 %, +0.54 stop"
std::string LabelOfLight(const StateAnswer& answer) {
  if (!answer.promised_of_full || !(*answer.promised_of_full > 0.0)) return "";
  const double stops = std::log2(answer.relative_to_full.value / *answer.promised_of_full);
  std::string text = RoundedText(100.0 * *answer.promised_of_full, 3) + " %";
  if (std::abs(stops) >= 0.005) text += ", " + Signed(stops, 2, "stop");
  return text;
}

std::string LabelOfColor(const StateAnswer& answer) {
  if (!answer.promised_cct_K || !answer.color.cct_K) return "";
  const double off = std::round(answer.color.cct_K->value - *answer.promised_cct_K);
  std::string text = RoundedText(*answer.promised_cct_K, 4) + " K";
  if (off != 0.0) text += ", " + Signed(off, 4, "K");
  return text;
}

std::string Beside(const std::string& label) { return label.empty() ? "" : " · label " + label; }

std::string StrengthText(const Uncertain& u, const std::string& unit) {
  return ValueText(u) + " " + unit + " (" + app::RangeText(u) + ") " + StopsText(u);
}

// "a mixture of 2 emitters, told by the spectra of 9 states within 0.3 %"
std::string SpectrumText(const FittedLight& light, const StateAnswer& answer) {
  if (!answer.spectrum) {
    const bool any = std::ranges::any_of(
        light.states, [](const MeasuredState& one) { return one.spectrum.has_value(); });
    return any ? "not known: too few were read to show what it mixes" : "";
  }
  std::string text = answer.basis == StateBasis::kMeasured ? "as it was read" : "";
  if (!light.emitters) return text;
  const FixtureEmitters& emitters = *light.emitters;
  if (!text.empty()) text += "; ";
  text += emitters.found.size() == 1
              ? "of one emitter"
              : "a mixture of " + std::to_string(emitters.found.size()) + " emitters";
  return text + ", told by the spectra of " + std::to_string(emitters.spectra) + " states within " +
         PercentText(emitters.residual);
}

// A panel that was read at two colour temperatures alone, asked between them.
std::string NextOf(const FittedLight& light, const FixtureState& at) {
  const auto here = NumberOfControl(at, kCctControl);
  if (!here) return "";
  double low = *here, high = *here;
  for (const MeasuredState& one : light.states) {
    const double kelvin = NumberOfControl(one.state, kCctControl).value_or(*here);
    low = std::min(low, kelvin);
    high = std::max(high, kelvin);
  }
  const auto is_end = [&](const MeasuredState& one) {
    const double kelvin = NumberOfControl(one.state, kCctControl).value_or(*here);
    return kelvin == low || kelvin == high;
  };
  if (!(low < *here && *here < high) || !std::ranges::all_of(light.states, is_end)) return "";
  const double middle = 100.0 * std::round(0.01 * std::sqrt(low * high));
  return "read one state near the middle, " + std::string(kCctControl) + "=" +
         RoundedText(middle, 4) + ": its two ends do not tell how a lamp fades between them";
}

std::string Told(const FittedLight& light, const StateAnswer& answer) {
  std::string text = light.name + " at " + StateText(answer.state) + ": " +
                     std::string(kBasisTexts[static_cast<std::size_t>(answer.basis)]) + "\n";
  if (answer.intensity_cd) {
    text += LabelledLine("intensity", StrengthText(*answer.intensity_cd, "cd"));
  }
  if (answer.illuminance_lx) {
    text += LabelledLine("illuminance", StrengthText(*answer.illuminance_lx, "lx"));
  }
  text += LabelledLine("of full", OfFull(answer.relative_to_full) + Beside(LabelOfLight(answer)) +
                                      " (full: " + StateText(answer.full) + ")");
  const FittedColor& color = answer.color;
  if (color.cct_K) {
    text += LabelledLine("CCT", ValueText(*color.cct_K) + " K (" + app::RangeText(*color.cct_K) +
                                    ")" + Beside(LabelOfColor(answer)));
  }
  if (color.duv) {
    text += LabelledLine("Duv", DuvText(color.duv->value) + " ± " + RoundedText(color.duv->u95, 2));
  }
  const std::string spectrum = SpectrumText(light, answer);
  if (!spectrum.empty()) text += LabelledLine("spectrum", spectrum);
  const std::string next = NextOf(light, answer.state);
  if (!next.empty()) text += LabelledLine("next", next);
  return text;
}

Node ColorNode(const FittedColor& color) {
  Node node = Node::Table();
  if (color.cct_K) node.Put("cct_K", DocumentOf(*color.cct_K));
  if (color.duv) {
    node.Put("duv", color.duv->value);
    node.Put("duv_u95", color.duv->u95);
  }
  if (color.xy) node.Put("xy", Node{color.xy->x, color.xy->y});
  return node;
}

// What is known of its spectrum.
Node SpectrumNode(const FittedLight& light, const StateAnswer& answer) {
  Node node = Node::Table();
  const StateSpectrum& spectrum = *answer.spectrum;
  Node values = {{"quantity", "irradiance"}};
  values.Put("wavelengths_nm", spectrum.spectrum.wavelengths_nm);
  values.Put("values", spectrum.spectrum.values);
  if (!spectrum.u95.empty()) values.Put("u95", spectrum.u95);
  node.Put("spectrum", std::move(values));
  if (!light.emitters) return node;
  Node emitters = Node::Table();
  emitters.Put("found", static_cast<int>(light.emitters->found.size()));
  emitters.Put("spectra", light.emitters->spectra);
  emitters.Put("residual", light.emitters->residual);
  if (!spectrum.shares.empty()) emitters.Put("shares", spectrum.shares);
  node.Put("emitters", std::move(emitters));
  return node;
}

Node AnswerNode(const FittedLight& light, const StateAnswer& answer) {
  Node node = {{"light", light.name},
               {"state", StateNode(answer.state)},
               {"basis", BasisWord(answer.basis)}};
  if (answer.intensity_cd) node.Put("intensity_cd", DocumentOf(*answer.intensity_cd));
  if (answer.illuminance_lx) node.Put("illuminance_lx", DocumentOf(*answer.illuminance_lx));
  node.Put("relative_to_full", DocumentOf(answer.relative_to_full));
  node.Put("full", StateNode(answer.full));
  node.Put(ColorNode(answer.color));
  Node label = Node::Table();
  label.Put("relative_to_full", Node(answer.promised_of_full));
  label.Put("cct_K", Node(answer.promised_cct_K));
  node.Put("label", Node::UnlessEmpty(std::move(label)));
  return node;
}

// A state that was read against what the others say of it.
struct LeftOut {
  double light = 0.0, half_width = 0.0;
  std::string interval;
  std::optional<double> cct_K;
};
std::optional<LeftOut> LeftOutOf(const FittedLight& light, std::size_t index) {
  const auto without = AnswerWithout(light, index);
  if (!without) return std::nullopt;
  const MeasuredState& read = light.states[index];
  LeftOut out;
  out.light = without->relative.value / read.relative.value - 1.0;
  out.half_width = without->relative.u95 / without->relative.value;
  out.interval = RelativeText(without->relative);
  if (without->color.cct_K && read.color.cct_K) {
    out.cct_K = without->color.cct_K->value - read.color.cct_K->value;
  }
  return out;
}

struct ToldStates {
  Node node;
  bool any_left_out = false;  // whether some state could be told by the others
};
// The table of one light's states, and the same for machines.
Result<ToldStates> TellAll(const FittedLight& light, Console& console) {
  std::vector<std::vector<std::string>> rows;
  bool any_left_out = false;
  Node states = Node::Array();
  for (std::size_t i = 0; i < light.states.size(); ++i) {
    const auto answer = AnswerState(light, light.states[i].state);
    if (!answer) return tl::unexpected(answer.error());
    const auto left_out = LeftOutOf(light, i);
    any_left_out = any_left_out || left_out;
    const Uncertain* strength = answer->intensity_cd
                                    ? &*answer->intensity_cd
                                    : (answer->illuminance_lx ? &*answer->illuminance_lx : nullptr);
    const FittedColor& color = answer->color;
    rows.push_back({StateText(answer->state), strength == nullptr ? kNone : ValueText(*strength),
                    OfFull(answer->relative_to_full), LabelOfLight(*answer),
                    color.cct_K ? ValueText(*color.cct_K) + " K" : kNone, LabelOfColor(*answer),
                    left_out
                        ? Signed(100.0 * left_out->light, 2, "%") + " (" + left_out->interval + ")"
                        : kNone});
    Node node = AnswerNode(light, *answer);
    if (left_out) {
      Node without = {{"relative_error", left_out->light}, {"u95_relative", left_out->half_width}};
      without.Put("cct_error_K", Node(left_out->cct_K));
      node.Put("left_out", std::move(without));
    }
    states.items.push_back(std::move(node));
  }
  const std::string unit = light.intensity_cd ? "cd" : "lx";
  // The reference, then by their labels: a sweep reads them shuffled.
  if (!rows.empty()) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < rows.size(); ++i) order.push_back(i);
    std::ranges::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
      return std::ranges::lexicographical_compare(
          light.states[b].state, light.states[a].state,
          [](const ControlValue& one, const ControlValue& other) {
            return std::pair(one.number, other.word) < std::pair(other.number, one.word);
          });
    });
    std::vector<std::vector<std::string>> sorted;
    for (const std::size_t i : order) sorted.push_back(std::move(rows[i]));
    rows = std::move(sorted);
  }
  std::vector<std::string> header = {"state", unit, "of full", "label", "CCT", "label", "left out"};
  if (!any_left_out) {
    header.pop_back();
    for (std::vector<std::string>& row : rows) row.pop_back();
  }
  console.Print(light.name + ", " + unit + " by what its controls say:\n" +
                TextTable(header, rows));
  return ToldStates{{{"light", light.name}, {"states", std::move(states)}}, any_left_out};
}

Result<void> TellTables(const LightFile& file, const StateOptions& options, Console& console) {
  Node lights = Node::Array();
  bool any_left_out = false;
  for (const FittedLight& light : file.lights) {
    const bool wanted = options.light.empty() || light.name == options.light;
    if (!wanted || light.states.empty()) continue;
    if (!lights.items.empty()) console.Print("\n");
    auto told = TellAll(light, console);
    if (!told) return Propagate(std::move(told));
    lights.items.push_back(std::move(told->node));
    any_left_out = any_left_out || told->any_left_out;
  }
  if (any_left_out) {
    console.Print("\nleft out: what the other states say of it, against what was read.\n");
  }
  console.PrintDocument({{"lights", std::move(lights)}});
  return {};
}

Result<void> RunState(const StateOptions& options, Console& console) {
  FixtureState at;
  if (!options.at.empty()) {
    auto parsed = ParseFixtureState(options.at);
    if (!parsed) return Propagate(std::move(parsed));
    at = *std::move(parsed);
  }
  const auto file = LightsOf(options.input, console);
  if (!file) return tl::unexpected(file.error());
  const bool any = std::ranges::any_of(file->lights, [&](const FittedLight& one) {
    return !one.states.empty() && (options.light.empty() || one.name == options.light);
  });
  if (at.empty() && !options.spectrum.empty()) {
    return WrongUsage("--spectrum", "is of one state: say which by --at");
  }
  if (at.empty() && any) return TellTables(*file, options, console);
  const auto light = LightOf(*file, options);
  if (!light) return tl::unexpected(light.error());
  const auto answer = AnswerState(**light, at);
  if (!answer) return tl::unexpected(answer.error());
  if (const auto combined = CombinedWarning((*light)->name, answer->state, answer->basis))
    console.Warn(*combined);
  if (const auto shared = SharedGeometryWarning(**light, at)) console.Warn(*shared);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<OutputFile> files;
  if (!options.spectrum.empty()) {
    const auto spectrum = SpectrumOf(**light, *answer);
    if (!spectrum) return tl::unexpected(spectrum.error());
    files.push_back(
        {options.spectrum,
         SpectrumCsv(spectrum->spectrum, "of " + (*light)->name + " at " + StateText(at))});
    if (auto written = WriteOutputs(files, options.force); !written) return written;
  }
  console.Print(Told(**light, *answer) + WroteLine(files, "") + (files.empty() ? "" : "\n"));
  Node node = AnswerNode(**light, *answer);
  if (answer->spectrum) node.Put(SpectrumNode(**light, *answer));
  if (!files.empty()) node.Put("files", Node::List(PathsOf(files)));
  console.PrintDocument(std::move(node));
  return {};
}

}  // namespace

Run BuildState(CLI::App& parser) {
  auto options = std::make_shared<StateOptions>();
  parser.add_option("input", options->input, "A session, or a light.json of one")->required();
  parser.add_option("--light", options->light, "Which light [the one that has states]");
  parser.add_option("--at", options->at,
                    "What its controls say: dimmer=12,cct_K=4500 [a table of all that was read]");
  parser.add_option(
      "--spectrum", options->spectrum,
      "Write its spectrum there, W m-2 nm-1: as it was read, or what its emitters mix");
  parser.add_flag("--force", options->force, "Replace a file that lightcal did not write");
  return [options](Console& console) { return RunState(*options, console); };
}

}  // namespace lightcal::app
