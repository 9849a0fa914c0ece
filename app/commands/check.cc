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

#include "check_preset.h"
#include "commands.h"
#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/render_lamps.h"
#include "lightcal/presets/check/render_shape.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal_devices/captures/picture.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

struct CheckOptions {
  PresetCheck preset;
  std::string engine;
  std::vector<std::string> renders, rigs;
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

Node RenderedLampNode(const RenderedLamp& lamp) {
  return {{"name", lamp.name}, {"factor", lamp.factor}};
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
  const std::array<SeenRig, 1> alone = {SeenRig{&seen.rig, &verdict}};
  return {{"illuminance_lx", verdict.lux},
          {"expected_lx", verdict.expected_lx},
          {"stops_off", std::log2(verdict.lux / verdict.expected_lx)},
          {"cause", CauseNode(verdict.cause)},
          {"alternatives", Node::List(verdict.alternatives, CauseNode)},
          {"not_seen", Node::UnlessEmpty(Node::List(LampsNotSeen(alone)))},
          {"cards", measured}};
}

std::string PlaceText(const CheckedRig& rig) {
  std::string text = rig.lamps.size() > 1 ? rig.lamps[rig.lamp].name + ", " : "";
  text += RoundedText(rig.off_axis_deg, 4) + " deg";
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
  console.PrintDocument(
      {{"cause", CauseNode(causes.front())},
       {"alternatives", Node::List(others, CauseNode)},
       {"lamps", Node::UnlessEmpty(Node::List(RenderedLamps(seen), RenderedLampNode))},
       {"not_seen", Node::UnlessEmpty(Node::List(LampsNotSeen(seen)))},
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

Result<void> RunCheck(const CheckOptions& options, Console& console) {
  if (!options.renders.empty()) return CheckRender(options, console);
  if (options.preset.file.empty() || options.preset.session.empty()) {
    return WrongUsage("check",
                      "needs PRESET --session SESSION, or --render PICTURE --rig PRESET.json");
  }
  return CheckPreset(options.preset, console);
}

}  // namespace

Run BuildCheck(CLI::App& parser) {
  auto options = std::make_shared<CheckOptions>();
  parser.add_option("preset", options->preset.file, "An exported file: " + ReadableEndings(" "));
  parser.add_option("--session", options->preset.session, "The readings it is checked against");
  parser
      .add_option("--state", options->preset.states,
                  "The preset is of lights at this state, as export writes it: "
                  "[LIGHT:]dimmer=18,cct_K=4500")
      ->allow_extra_args(false);
  parser.add_option("--white", options->preset.white,
                    "What the preset's pipeline shows as white, as export wrote it [D65]");
  parser
      .add_option("--max-error", options->preset.max_error,
                  "Exit 1 where the rms over a light's readings is beyond this")
      ->default_str(options->preset.max_error);
  parser
      .add_option(
          "--render", options->renders,
          "A picture an engine rendered of the rig; several, each with its --rig (export "
          "--rig-at), show what one cannot: a cone law, a turned or mirrored panorama, which "
          "lamp of several is wrong")
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
