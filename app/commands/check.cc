// SPDX-License-Identifier: Apache-2.0
// lightcal check: a preset file against the readings, or a rendered picture against the meter.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration_options.h"
#include "check_cause.h"
#include "commands.h"
#include "input_files.h"
#include "lamp_state.h"
#include "lightcal/calibrate/wall_part.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/compare_readings.h"
#include "lightcal/presets/check/read_preset.h"
#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/render_shape.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal_devices/captures/picture.h"
#include "output_files.h"
#include "preset_input.h"

namespace lightcal::app {
namespace {

// Nothing but rounding is left: a table shows 0.
double BeyondRounding(double value, double of) { return std::abs(value) < 1e-7 * of ? 0.0 : value; }

struct CheckOptions {
  std::string preset, session, engine, max_error = "5%";
  std::vector<std::string> renders, rigs, states;
};

// ---- a picture ----

std::vector<std::string> Renderers() {
  std::vector<std::string> words;
  for (const PresetTarget* target : ReportTargets()) {
    for (const Renderer& renderer : target->renderers) words.emplace_back(renderer.word);
  }
  words.emplace_back("other");
  return words;
}

Node CauseNode(const RenderCause& cause) {
  return {{"code", cause.code},
          {"message", cause.message},
          {"factor", cause.factor},
          {"turn_deg", cause.turn_deg}};
}

void PrintVerdict(const CheckedRig& rig, const RenderVerdict& verdict, Console& console) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 2; ++i) {
    const double expected = rig.cards[i].expected_lx;
    rows.push_back({rig.cards[i].name, RoundedText(expected, 4) + " lx",
                    RoundedText(verdict.card_lx[i], 4) + " lx",
                    RoundedText(std::log2(verdict.card_lx[i] / expected), 2)});
  }
  console.Print(TextTable({"card", "meter", "picture", "stops"}, rows));
  console.Print("\n" + RoundedText(verdict.lux, 4) + " lx, " +
                RoundedText(std::log2(verdict.lux / verdict.expected_lx), 2) +
                " stops off: " + verdict.cause.code + "\n  " + verdict.cause.message + "\n");
  for (const RenderCause& other : verdict.alternatives) {
    console.Print("or " + other.code + ": " + other.message + "\n");
  }
}

struct SeenPicture {
  CheckedRig rig;
  std::array<CardPixels, 2> cards;
  RenderVerdict verdict;
};

Result<SeenPicture> SeePicture(const std::string& render, const std::string& rig_file,
                               const CheckOptions& options, Console& console) {
  const auto text = ReadInputFile(rig_file);
  if (!text) return tl::unexpected(text.error());
  auto rig = RigFromPreset(*text, rig_file);
  if (!rig) return Propagate(std::move(rig));
  NoteInput(render);
  const auto picture = devices::ReadPicture(render);
  if (!picture) return tl::unexpected(picture.error());
  const bool linear = picture->info.meaning == SampleMeaning::kLinear;
  const PixelUnit unit = linear ? LinearPixelsOf(options.engine) : PixelUnit::kExposed;
  const auto cards = MeasureCards(*picture, *rig);
  if (!cards) return tl::unexpected(cards.error());
  auto verdict = JudgeRender(*rig, *cards, unit, render);
  if (!verdict) return Propagate(std::move(verdict));
  for (std::size_t i = 0; i < 2; ++i) {
    const CardPixels& card = (*cards)[i];
    if (card.clipped[0] || card.clipped[1] || card.clipped[2]) {
      console.Warn(
          {"clipped", rig->cards[i].name, "is clipped in this picture and left out there"});
    }
    if (card.spread > 0.15) {
      console.Warn({"uneven_card", rig->cards[i].name,
                    "is uneven where the rig says it is: another camera, or too few samples"});
    }
  }
  return SeenPicture{*std::move(rig), *cards, *std::move(verdict)};
}

Node NodeOf(const SeenPicture& seen) {
  Node measured = Node::Array();
  for (std::size_t i = 0; i < 2; ++i) {
    measured.items.push_back({{"name", seen.rig.cards[i].name},
                              {"expected_lx", seen.rig.cards[i].expected_lx},
                              {"illuminance_lx", seen.verdict.card_lx[i]},
                              {"pixel", seen.cards[i].rgb}});
  }
  const RenderVerdict& verdict = seen.verdict;
  return {{"illuminance_lx", verdict.lux},
          {"expected_lx", verdict.expected_lx},
          {"stops_off", std::log2(verdict.lux / verdict.expected_lx)},
          {"cause", CauseNode(verdict.cause)},
          {"alternatives", Node::List(verdict.alternatives, CauseNode)},
          {"cards", measured}};
}

std::string PlaceText(const CheckedRig& rig) {
  std::string text = RoundedText(rig.off_axis_deg, 4) + " deg";
  if (rig.round_deg != 0.0) text += " / " + RoundedText(rig.round_deg, 4);
  return text;
}

// One scene, its cards at several places: one cause for all.
void SayTogether(const std::vector<SeenPicture>& pictures, Console& console) {
  std::vector<SeenRig> seen;
  std::vector<std::vector<std::string>> rows;
  Node list = Node::Array();
  for (const SeenPicture& picture : pictures) {
    const RenderVerdict& verdict = picture.verdict;
    seen.push_back({&picture.rig, &picture.verdict});
    list.items.push_back(NodeOf(picture));
    rows.push_back({PlaceText(picture.rig), RoundedText(verdict.expected_lx, 4) + " lx",
                    RoundedText(verdict.lux, 4) + " lx",
                    RoundedText(std::log2(verdict.lux / verdict.expected_lx), 2)});
  }
  const std::vector<RenderCause> causes = JudgeTogether(seen);
  console.Print(TextTable({"cards at", "meter", "picture", "stops"}, rows));
  console.Print("\n" + causes.front().code + "\n  " + causes.front().message + "\n");
  const std::vector<RenderCause> others(causes.begin() + 1, causes.end());
  for (const RenderCause& other : others) {
    console.Print("or " + other.code + ": " + other.message + "\n");
  }
  console.PrintDocument({{"cause", CauseNode(causes.front())},
                         {"alternatives", Node::List(others, CauseNode)},
                         {"pictures", std::move(list)}});
}

Result<void> CheckRender(const CheckOptions& options, Console& console) {
  if (options.rigs.size() != options.renders.size()) {
    return WrongUsage("--rig",
                      "is the STEM.preset.json that was exported with the rig: one for each "
                      "--render, in their order");
  }
  std::vector<SeenPicture> pictures;
  for (std::size_t i = 0; i < options.renders.size(); ++i) {
    auto seen = SeePicture(options.renders[i], options.rigs[i], options, console);
    if (!seen) return Propagate(std::move(seen));
    pictures.push_back(*std::move(seen));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (pictures.size() > 1) {
    SayTogether(pictures, console);
    return {};
  }
  PrintVerdict(pictures.front().rig, pictures.front().verdict, console);
  console.PrintDocument(NodeOf(pictures.front()));
  return {};
}

// ---- a preset ----

// What of a session a preset is held against: its lights, at states of their controls where some
// are asked for.
Result<void> ToStates(const CheckOptions& options, CalibratedSession& calibrated,
                      Console& console) {
  const std::vector<FittedLight> references = calibrated.lights.lights;
  const auto warnings = SetStates(options.states, calibrated.lights);
  if (!warnings) return tl::unexpected(warnings.error());
  console.Warn(*warnings);
  for (std::size_t i = 0; i < references.size(); ++i) {
    FittedLight& there = calibrated.lights.lights[i];
    const bool asked = !references[i].states.empty() && there.states.empty();
    if (!asked || TakeReadingsOfState(references[i], there, calibrated.session) > 0) continue;
    return Refused("no_readings", there.name,
                   "was not read at " + StateText(there.state) +
                       "; check it at a state that was: " +
                       Joined(references[i].states, ", or ",
                              [](const MeasuredState& one) { return StateText(one.state); }));
  }
  return {};
}

// "" where no lamp has states that the preset may be of.
std::string PerhapsOfAState(const CheckOptions& options, const LightFile& lights) {
  const auto several = [](const FittedLight& light) { return light.states.size() > 1; };
  const auto one = std::ranges::find_if(lights.lights, several);
  if (!options.states.empty() || one == lights.lights.end()) return {};
  return ". A preset of another state than " + StateText(one->state) +
         " is checked with --state, as it was exported";
}

// Of a beam that was read at angles, where the engine has but a cone for it.
std::string PerhapsACone(const ComparedReading& worst) {
  if (worst.off_axis_deg == 0.0) return {};
  return "That is " + RoundedText(std::abs(worst.off_axis_deg), 3) +
         " degrees off the axis, where an engine's own cone may stray; .ies and .ldt hold the beam "
         "itself. ";
}

// "1.00 m, 15°"
std::string PlaceOf(const ComparedReading& row) {
  std::string place = row.distance_m ? RoundedText(*row.distance_m, 3) + " m" : kNone;
  if (row.off_axis_deg != 0.0) place += ", " + RoundedText(row.off_axis_deg, 3) + "°";
  return place;
}

// What the preset lacks, where that is more than it may.
std::optional<Error> Judged(const CheckOptions& options, const CalibratedSession& calibrated,
                            const std::vector<ComparedReading>& rows,
                            const std::vector<std::string>& missing, double rms, double max_error) {
  if (!missing.empty()) {
    return Error{ErrorKind::kFailed, "missing_lights", options.preset,
                 "has no light for " + Joined(missing) + "; export it from this session"};
  }
  if (rms <= max_error) return std::nullopt;
  const auto worst = std::ranges::max_element(rows, {}, [](const ComparedReading& row) {
    return row.used ? std::abs(row.Error().value_or(0.0)) : 0.0;
  });
  return Error{ErrorKind::kFailed, "preset_off", options.preset,
               "is " + PercentText(rms) + " (rms) off what the meter showed, more than " +
                   PercentText(max_error) + "; most at a reading of " + worst->light + ": " +
                   RoundedText(worst->predicted_lx, 4) + " lx instead of " +
                   RoundedText(worst->measured_lx, 4) + " lx. " + PerhapsACone(*worst) +
                   CauseOfStraying(options.preset, calibrated, rows, max_error) +
                   "; --max-error allows more" + PerhapsOfAState(options, calibrated.lights)};
}

Result<void> CheckPreset(const CheckOptions& options, Console& console) {
  const auto max_error = ParseTolerance(options.max_error);
  if (!max_error) return tl::unexpected(max_error.error());
  const auto text = ReadInputFile(options.preset);
  if (!text) return tl::unexpected(text.error());
  const auto lights = LightsOfPreset(options.preset, *text, FilesBeside(options.preset));
  if (!lights) return tl::unexpected(lights.error());
  auto calibrated = CalibrateAloud(options.session, {}, console);
  if (!calibrated) return tl::unexpected(calibrated.error());
  if (auto there = ToStates(options, *calibrated, console); !there) return there;
  const auto rows = ComparedWith(*calibrated, *lights);
  const auto missing = LampsMissing(calibrated->session, calibrated->lights, *lights);
  const auto rms = RmsOf(rows);
  if (!rms) {
    return Refused("no_readings", options.session, "has no reading to check against");
  }
  if (std::ranges::any_of(
          rows, [](const ComparedReading& row) { return !std::isfinite(row.predicted_lx); })) {
    return Refused("bad_preset", options.preset,
                   "gives no finite illuminance at a reading; look at its numbers");
  }
  if (const PresetTarget* target = TargetOfFile(options.preset);
      target != nullptr && target->name == "blender") {
    console.Warn(OldBlenderSpheres(calibrated->session, calibrated->lights));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<Node> readings;
  std::vector<std::vector<std::string>> table;
  for (const ComparedReading& row : rows) {
    readings.push_back(
        {{"light", row.light},
         {"index", row.index},
         {"measured_lx", row.measured_lx},
         {"walls_lx", row.walls_lx},
         {"predicted_lx", row.predicted_lx},
         {"used", row.used},
         {"distance_m", row.distance_m},
         {"off_axis_deg", row.off_axis_deg == 0.0 ? Node() : Node(row.off_axis_deg)}});
    std::string error = kNone;
    if (const auto relative = row.Error()) {
      readings.back().Put("error", *relative);
      error = PercentText(BeyondRounding(*relative, 1.0));
    }
    table.push_back(
        {row.light, PlaceOf(row), RoundedText(row.measured_lx + row.walls_lx, 4) + " lx",
         RoundedText(BeyondRounding(row.walls_lx, row.measured_lx), 3) + " lx",
         RoundedText(row.predicted_lx, 4) + " lx", error + (row.used ? "" : " (rejected)")});
  }
  console.Print(TextTable({"light", "distance", "meter", "of it walls", "preset", "error"}, table));
  console.Print("\nrms " + PercentText(BeyondRounding(*rms, 1.0)) + " of what the meter showed\n");
  Node document = {{"readings", readings},
                   {"rms_relative", *rms},
                   {"max_error", *max_error},
                   {"missing", Node::UnlessEmpty(Node(missing))}};
  if (const auto fault = Judged(options, *calibrated, rows, missing, *rms, *max_error)) {
    return EndWithError(console, std::move(document), *fault);
  }
  console.PrintDocument(std::move(document));
  return {};
}

Result<void> RunCheck(const CheckOptions& options, Console& console) {
  if (!options.renders.empty()) return CheckRender(options, console);
  if (options.preset.empty() || options.session.empty()) {
    return WrongUsage("check",
                      "needs PRESET --session SESSION, or --render PICTURE --rig PRESET.json");
  }
  return CheckPreset(options, console);
}

}  // namespace

Run BuildCheck(CLI::App& parser) {
  auto options = std::make_shared<CheckOptions>();
  parser.add_option("preset", options->preset, "An exported file: " + ReadableEndings(" "));
  parser.add_option("--session", options->session, "The readings it is checked against");
  parser
      .add_option("--state", options->states,
                  "The preset is of lights at this state, as export writes it: "
                  "[LIGHT:]dimmer=18,cct_K=4500")
      ->allow_extra_args(false);
  parser
      .add_option("--max-error", options->max_error,
                  "Exit 1 where the rms over the readings is beyond this")
      ->default_str(options->max_error);
  parser
      .add_option("--render", options->renders,
                  "A picture an engine rendered of the rig; several, each with its --rig (export "
                  "--rig-at), show what one cannot: a cone law, a turned or mirrored panorama")
      ->allow_extra_args(false);
  parser.add_option("--rig", options->rigs, "The STEM.preset.json of that rig")
      ->allow_extra_args(false);
  parser
      .add_option("--engine", options->engine,
                  "Who rendered it: an EXR of blender holds watts, one of three cd/m2; any other "
                  "picture is exposed")
      ->check(CLI::IsMember(Renderers()));
  return [options](Console& console) { return RunCheck(*options, console); };
}

}  // namespace lightcal::app
